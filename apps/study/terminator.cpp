// SPDX-License-Identifier: Apache-2.0
//
// Compares ways to treat pixels near the terminator of a coarse mesh with a normal map. The reference is the displaced surface, ray-traced
// with a mesh that is finer than the texels of its map. Its error is the difference from a mesh of half as many sectors.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/reference/pixel_truth.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/shadow/terminator.h"
#include "study/study.h"

namespace halfspace {

namespace {

// A pixel near the terminator. `hanika`: offset to the tangent planes of the vertices.
struct TerminatorPixel {
  ShadowReceiver<float> receiver;
  vec3<float> hanika;
  float smooth_l, shading_l, face_l, smooth_shading;  // cosines of the angles of the normals to the light, and to each other
  double truth, coarser_truth;
};

SceneFile terminator_scene(int longitudes, int relief) {
  SceneFile file = SceneFile::open("moon");
  file.set(std::vector<std::string>{"camera=terminator", fmt::format("relief.width={}", relief),
                                    fmt::format("moon.longitudes={}", longitudes), fmt::format("moon.latitudes={}", longitudes / 2)});
  return file;
}

struct TerminatorFrame {
  TerminatorFrame(SceneAssets& assets, int longitudes, int relief, int width, int height, const Workers& workers)
      : scene(assets.prepare(terminator_scene(longitudes, relief).at(0.0), width, height)),
        rays(scene.meshes, scene.view.eye_ws),
        hits(primary_hits(rays, scene.view, width, height, workers)),
        normal(width, height) {
    FrameImages images;
    images.normal = &normal;
    render_frame(scene, images, workers);
  }
  glm::dvec3 to_light() const { return glm::dvec3(scene.lights.front().light.position_rws); }

  PreparedScene scene;
  RayScene rays;
  Image<std::optional<RayHit>> hits;
  Image<glm::vec3> normal;
};

vec3<float> single(const glm::dvec3& v) { return vec3<float>(glm::vec3(v)); }

TerminatorPixel pixel_of(const TerminatorFrame& frame, const RayHit& hit, const glm::dvec3& shading) {
  const PlacedMesh& mesh = frame.scene.meshes[static_cast<std::size_t>(hit.mesh)];
  const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(mesh.world_from_object)));
  std::array<vec3<double>, 3> p, n;
  glm::dvec3 normal(0.0), hanika(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const uint32_t vertex = (*mesh.indices)[std::size_t{hit.triangle} * 3 + k];
    const glm::dvec3 unit = unit_or_zero(turn * glm::dvec3(mesh.normals[vertex]));
    const glm::dvec3 corner =
        glm::dvec3(mesh.world_from_object * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0)) - frame.scene.view.eye_ws;
    p[k] = vec3<double>(corner);
    n[k] = vec3<double>(unit);
    normal += hit.weights[k] * unit;
    hanika -= hit.weights[k] * std::min(0.0, glm::dot(hit.position_rws - corner, unit)) * unit;
  }
  normal = unit_or_zero(normal);
  const glm::dvec3 l = frame.to_light();
  TerminatorPixel out{{single(hit.position_rws), single(hit.face_normal_ws), single(shading), single(l), 0.5f, 0.5f},
                      single(hanika),
                      {},
                      {},
                      {},
                      {},
                      0.0,
                      0.0};
  out.receiver.smooth_normal_ws = single(normal);
  out.receiver.smooth_height = static_cast<float>(smooth_height(p, n, hit.weights));
  out.smooth_l = static_cast<float>(glm::dot(normal, l));
  out.shading_l = static_cast<float>(glm::dot(shading, l));
  out.face_l = static_cast<float>(glm::dot(hit.face_normal_ws, l));
  out.smooth_shading = static_cast<float>(glm::dot(normal, shading));
  return out;
}

// Returns the light at a pixel of the displaced surface, where the light of a surface that faces the Sun is 1.
double light_at(const TerminatorFrame& frame, int x, int y) {
  const RayHit& hit = *frame.hits.at(x, y);
  const glm::dvec3 l = frame.to_light();
  if (glm::dot(hit.face_normal_ws, l) <= 0.0) return 0.0;
  const RayLight sun{frame.scene.lights.front().light, 0.0, 1};
  if (light_truth(frame.rays, sun, hit.position_rws, hit.face_normal_ws, 0).share <= 0.5f) return 0.0;
  return std::max(0.0, glm::dot(glm::dvec3(frame.normal.at(x, y)), l));
}

// Returns the pixels whose shading normal faces the light, and whose triangle is within 6 degrees of the light's direction or faces away.
std::vector<TerminatorPixel> pixels_near_terminator(const TerminatorFrame& frame, const TerminatorFrame& coarser,
                                                    const TerminatorFrame& finest) {
  std::vector<TerminatorPixel> pixels;
  const glm::dvec3 l = frame.to_light();
  for (int y = 0; y < frame.hits.height(); ++y) {
    for (int x = 0; x < frame.hits.width(); ++x) {
      const std::optional<RayHit>& hit = frame.hits.at(x, y);
      if (!hit || !coarser.hits.at(x, y) || !finest.hits.at(x, y)) continue;
      const glm::dvec3 shading(frame.normal.at(x, y));
      if (glm::dot(shading, l) <= 0.0 || glm::dot(hit->face_normal_ws, l) > 0.1) continue;
      TerminatorPixel p = pixel_of(frame, *hit, shading);
      p.truth = light_at(finest, x, y);
      p.coarser_truth = light_at(coarser, x, y);
      pixels.push_back(p);
    }
  }
  return pixels;
}

// A lookup that knows only the triangle and the shading normal.
float mapped_normal_only(const Shadow& shadow, const TerminatorPixel& p) {
  ShadowReceiver<float> at = p.receiver;
  at.smooth_normal_ws = vec3<float>(0.0f);
  at.smooth_height = 0.0f;
  return shadow_factor(shadow, at);
}

float with_slope_bias(const Shadow& shadow, const TerminatorPixel& p) {
  Shadow sloped{shadow.views, shadow.settings};
  sloped.settings.bias = ShadowBias::slope;
  return mapped_normal_only(sloped, p);
}

float with_face_gate(const Shadow& shadow, const TerminatorPixel& p) { return p.face_l > 0.0f ? mapped_normal_only(shadow, p) : 0.0f; }

// J. Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
float with_tangent_planes(const Shadow& shadow, const TerminatorPixel& p) {
  TerminatorPixel moved = p;
  moved.receiver.position_rws += p.hanika;
  return mapped_normal_only(shadow, moved);
}

// M. J.-Y. Chiang, Y. K. Li and B. Burley, "Taming the shadow terminator", SIGGRAPH talks 2019.
float with_chiang(const Shadow& shadow, const TerminatorPixel& p) {
  if (p.smooth_l <= 0.0f) return 0.0f;
  const float g = std::clamp(p.smooth_l / (p.shading_l * p.smooth_shading), 0.0f, 1.0f);
  return g * (1.0f + g - g * g) * mapped_normal_only(shadow, p);
}

// A. Conty Estevez, P. Lecocq and C. Stein, "A microfacet-based shadowing function to solve the bump terminator problem", Ray Tracing Gems,
// 2019: masking by GGX microfacets whose roughness follows from the angle between the two normals.
float with_microfacets(const Shadow& shadow, const TerminatorPixel& p) {
  if (p.smooth_l <= 0.0f) return 0.0f;
  const auto tan2 = [](float cosine) { return (1.0f - cosine * cosine) / std::max(cosine * cosine, 1e-12f); };
  const float alpha2 = std::clamp(0.125f * tan2(p.smooth_shading), 0.0f, 1.0f);
  return 2.0f / (1.0f + std::sqrt(1.0f + alpha2 * tan2(p.smooth_l))) * mapped_normal_only(shadow, p);
}

float used_here(const Shadow& shadow, const TerminatorPixel& p) { return shadow_factor(shadow, p.receiver); }

Variant variant_of(const char* name, float (*method)(const Shadow&, const TerminatorPixel&), const Shadow& shadow,
                   const std::vector<TerminatorPixel>& pixels, const StudyOptions& options) {
  std::vector<float> shares(pixels.size());
  Variant v{.name = name, .group = "methods", .parameters = {{"pixels", static_cast<double>(pixels.size())}}};
  v.time = time_of(
      [&] {
        for (std::size_t i = 0; i < pixels.size(); ++i) shares[i] = method(shadow, pixels[i]);
      },
      options);
  constexpr double kLeak = 0.02;  // light in a shadow that is seen at once: code 39 of 255
  double falsely_lit = 0.0, falsely_dark = 0.0;
  int leaks = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double error = static_cast<double>(shares[i] * pixels[i].shading_l) - pixels[i].truth;
    (error > 0.0 ? falsely_lit : falsely_dark) += std::abs(error);
    leaks += pixels[i].truth == 0.0 && error > kLeak;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, pixels.size()));
  v.error = (falsely_lit + falsely_dark) / count;
  v.measures = {{"false_light", falsely_lit / count}, {"false_shadow", falsely_dark / count}, {"leaks", leaks / count}};
  return v;
}

}  // namespace

Study study_terminator(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 160 : 640, height = width * 9 / 16, sectors = options.quick ? 1024 : 3072,
            relief = options.quick ? 256 : 1024;
  SceneAssets assets(workers), coarser_assets(workers), finest_assets(workers);
  const TerminatorFrame frame(assets, 64, relief, width, height, workers),
      coarser(coarser_assets, sectors / 2, relief, width, height, workers), finest(finest_assets, sectors, relief, width, height, workers);
  const std::vector<TerminatorPixel> pixels = pixels_near_terminator(frame, coarser, finest);
  double difference = 0.0;
  for (const TerminatorPixel& p : pixels) difference += std::abs(p.truth - p.coarser_truth);
  const Shadow& shadow = *frame.scene.lights.front().light.shadow;
  Study study{
      .name = "terminator",
      .title = "Normal maps near the terminator",
      .setting = fmt::format("Moon of 64 sectors, {}x{}; pixels whose normal faces the Sun, in triangles that do by at most 6 degrees",
                             width, height),
      .error_name = "mean error of the light at these pixels",
      .time_name = "shadow lookups of these pixels on one thread, one lane",
      .truth = {fmt::format("rays, {} sectors", sectors), difference / static_cast<double>(std::max<std::size_t>(1, pixels.size())),
                fmt::format("difference from {} sectors", sectors / 2)},
  };
  const auto add = [&](const char* name, float (*method)(const Shadow&, const TerminatorPixel&)) {
    study.variants.push_back(variant_of(name, method, shadow, pixels, options));
  };
  add("slope bias", with_slope_bias);
  add("mapped normal only", mapped_normal_only);
  add("dark if the triangle faces away", with_face_gate);
  add("tangent planes (Hanika)", with_tangent_planes);
  add("ratio of cosines (Chiang)", with_chiang);
  add("microfacets (Conty Estevez)", with_microfacets);
  add("smooth surface (used here)", used_here);
  return study;
}

}  // namespace halfspace
