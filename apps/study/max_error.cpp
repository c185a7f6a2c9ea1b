// SPDX-License-Identifier: Apache-2.0
//
// `render --max-error`: compares the models that it picks for the Moon and the Earth with fixed models.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/scene/shapes.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr int kDirections = 8192;

// Computes the outline of a mesh in the image: in each direction from the projected object center, the distance in pixels to the
// farthest intersection with an edge of the mesh.
std::vector<double> outline(const PlacedMesh& placed, const View& view) {
  const glm::dmat4 clip_from_object = view.clip_from_world * placed.world_from_object;
  const auto window = [&](const glm::dvec4& p) {
    const glm::dvec4 c = clip_from_object * p;
    return glm::dvec2(0.5 * c.x / c.w * view.width_px, 0.5 * c.y / c.w * view.height_px);
  };
  const glm::dvec2 middle = window({0, 0, 0, 1});
  std::vector<glm::dvec2> at;
  for (const glm::vec3& p : placed.positions) at.push_back(window(glm::dvec4(p, 1)) - middle);
  std::vector<double> farthest(kDirections, 0.0);
  const auto turns = [](const glm::dvec2& p) { return std::atan2(p.y, p.x) / (2.0 * std::numbers::pi) + 0.5; };
  const Indices& indices = *placed.indices;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    glm::dvec2 a = at[indices[i]], b = at[indices[i % 3 == 2 ? i - 2 : i + 1]];
    double from = turns(a), to = turns(b);
    if (to < from) {
      std::swap(a, b);
      std::swap(from, to);
    }
    if (to - from > 0.5) {  // the edge crosses the direction where the angle wraps around
      std::swap(a, b);
      from = std::exchange(to, from + 1.0);
    }
    if (to - from > 0.25) continue;  // the edge passes close to the center, so it is not part of the outline
    const glm::dvec2 along = b - a;
    for (int k = static_cast<int>(std::ceil(from * kDirections)); k <= static_cast<int>(to * kDirections); ++k) {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(k) / kDirections - 0.5);
      const glm::dvec2 d(std::cos(angle), std::sin(angle));
      const double slope = d.x * along.y - d.y * along.x;
      // The intersection with a nearly radial edge is ill-conditioned. Rounding can move it beyond the end of the edge, so clamp it.
      const double end = std::max(glm::length(a), glm::length(b));
      const double met = slope == 0.0 ? end : std::min(end, (a.x * along.y - a.y * along.x) / slope);
      double& reached = farthest[static_cast<std::size_t>(k % kDirections)];
      reached = std::max(reached, met);
    }
  }
  return farthest;
}

double farthest_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double max_difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) max_difference = std::max(max_difference, std::abs(a[i] - b[i]));
  return max_difference;
}

struct Candidate {
  std::string name, group;
  SceneDescription scene;
};

SceneDescription with_bands(SceneDescription scene, int bands, int samples) {
  scene.objects.front().second = with_parts(scene.objects.front().second, bands, true);
  scene.head.samples = samples;
  return scene;
}

std::vector<Candidate> candidates_of(const std::string& name, const SceneDescription& scene, SceneAssets& assets, const View& size,
                                     bool quick) {
  std::vector<Candidate> candidates;
  for (const int samples : {1, 8}) {
    for (const int bands : quick ? std::vector{16, 64} : std::vector{32, 64, 128, 256})
      candidates.push_back({fmt::format("{} {} bands, {}", name, bands, samples), fmt::format("{}, {} samples", name, samples),
                            with_bands(scene, bands, samples)});
  }
  for (const double px : quick ? std::vector{1.0} : std::vector{2.0, 1.0, 0.5, 0.25, 0.1, 0.05})
    candidates.push_back({fmt::format("{} {} px", name, px), name + ", --max-error",
                          assets.choose_within_error(scene, size.width_px, size.height_px, {px, {}}).scene});
  return candidates;
}

}  // namespace

Study study_max_error(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 320 : 1920, height = options.quick ? 180 : 1080, finest = options.quick ? 256 : 1536;
  Study study{
      .name = "max_error",
      .title = "The cheapest model: --max-error and fixed models",
      .setting = fmt::format("Moon and Earth, {}x{}; labels: maximum error in px, or latitude bands and samples per pixel", width, height),
      .error_name = "largest error of the outline, in pixels",
      .time_name = "frame with its shadow maps; textures and meshes are cached",
      .truth = {fmt::format("the same scene with {} bands", finest), 0.0, "a third of the change from half as many bands"},
  };
  for (const std::string name : {"moon", "earth"}) {
    SceneFile file = SceneFile::open(name);
    // The relief is so coarse that the reference mesh resolves all of it.
    if (name == "moon") file.set(fmt::format("relief.width={}", options.quick ? 64 : 256));
    const SceneDescription scene = file.description();
    SceneAssets assets(workers);
    const auto outline_by = [&](const SceneDescription& s) {
      const PreparedScene prepared = assets.prepare(s, width, height);
      return outline(prepared.meshes.front(), prepared.view);
    };
    const std::vector<double> truth = outline_by(with_bands(scene, finest, 1));
    study.truth.error = std::max(study.truth.error, farthest_apart(truth, outline_by(with_bands(scene, finest / 2, 1))) / 3.0);
    const View size = make_view(scene.cameras.front().second, width, height);
    for (const Candidate& candidate : candidates_of(name, scene, assets, size, options.quick)) {
      Image<glm::u8vec4> picture(width, height);
      PassStatistics statistics;
      double texels = 0.0;
      Variant v{.name = candidate.name, .group = candidate.group, .error = farthest_apart(truth, outline_by(candidate.scene))};
      v.time = time_of(
          [&] {
            const PreparedScene prepared = assets.prepare(candidate.scene, width, height);
            statistics = render(prepared, picture, workers);
            const Shadow* shadow = prepared.lights.front().light.shadow;
            texels = shadow == nullptr ? 0.0 : shadow->views.front().size;
          },
          options);
      v.parameters = {{"triangles", static_cast<double>(statistics.primitives_in)},
                      {"samples", static_cast<double>(candidate.scene.head.samples)},
                      {"shadow_texels", texels}};
      v.picture = picture;
      study.variants.push_back(std::move(v));
    }
  }
  return study;
}

}  // namespace halfspace
