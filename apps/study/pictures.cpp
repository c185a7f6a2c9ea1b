// SPDX-License-Identifier: Apache-2.0
#include "study/pictures.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/srgb.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

namespace {

// Returns the light along the ray through window coordinates (x, y), with y down. Uses the formulas of shading/light/lighting.h.
template <class T>
T light_along(const LitSphere& s, const View& view, T x, T y) {
  using V = glm::vec<3, T>;
  const V forward(view.forward_ws), right(view.right_ws), up(view.up_ws);
  const V d = glm::normalize(forward + right * (T(view.tan_x) * (2 * x / T(view.width_px) - 1)) +
                             up * (T(view.tan_y) * (1 - 2 * y / T(view.height_px))));
  const V from = V(view.eye_ws) - V(s.center_ws);
  const T b = glm::dot(from, d), c = glm::dot(from, from) - T(s.radius) * T(s.radius), root = b * b - c;
  if (root < 0) return 0;
  const V p = from + d * (-b - std::sqrt(root));
  const V n = p / T(s.radius), l = glm::normalize(V(s.towards_light_ws)), v = -d;
  const T n_l = glm::dot(n, l);
  if (n_l <= 0) return T(s.ambient);
  const T cosine = s.model == LightModel::phong ? 2 * n_l * glm::dot(n, v) - glm::dot(l, v) : glm::dot(n, glm::normalize(l + v));
  return T(s.ambient) + T(s.diffuse) * n_l + T(s.specular) * std::pow(std::max(cosine, T(0)), T(s.shininess));
}

}  // namespace

TimedPicture timed_picture(const SceneDescription& scene, int width, int height, const StudyOptions& options, const Workers& workers) {
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(scene, width, height);
  TimedPicture out{Image<glm::vec4>(width, height), {}, {}};
  out.time = time_of([&] { out.statistics = render(prepared, out.light, workers); }, options);
  return out;
}

void set_truth(Truth& truth, const Image<glm::vec4>& light, const Image<glm::vec4>& half, PictureError kind) {
  Variant difference;
  set_picture_error(difference, half, light, kind);
  truth.error = difference.error / 3.0;
  truth.picture = codes_of(light);
}

Image<glm::u8vec4> codes_of(const Image<glm::vec4>& light) {
  Image<glm::u8vec4> codes(light.width(), light.height());
  std::ranges::transform(light.texels(), codes.data(), [](const glm::vec4& c) {
    return glm::u8vec4(linear_to_srgb(c.x), linear_to_srgb(c.y), linear_to_srgb(c.z), 255);
  });
  return codes;
}

void set_picture_error(Variant& variant, const Image<glm::vec4>& light, const Image<glm::vec4>& truth, PictureError kind) {
  const ImageDifference d = compare_images(light, truth);
  variant.error = kind == PictureError::rms ? d.rmse : d.mean;
  variant.measures.insert(variant.measures.end(), {{"rms", d.rmse}, {"mean", d.mean}, {"p999", d.p999}, {"max", d.max}, {"ssim", d.ssim}});
  variant.picture = codes_of(light);
  variant.difference = difference_colors(difference_map(light, truth));
}

SphereTruth sphere_truth(const LitSphere& sphere, const View& view) {
  SphereTruth out{Image<glm::vec4>(view.width_px, view.height_px), Image<double>(view.width_px, view.height_px), 0.0};
  for (int y = 0; y < view.height_px; ++y) {
    for (int x = 0; x < view.width_px; ++x) {
      const double light = light_along<double>(sphere, view, x + 0.5, y + 0.5);
      const long double finer = light_along<long double>(sphere, view, x + 0.5L, y + 0.5L);
      out.error = std::max(out.error, static_cast<double>(std::abs(finer - static_cast<long double>(light))));
      out.exact.at(x, y) = light;
      out.light.at(x, y) = glm::vec4(glm::vec3(static_cast<float>(light)), 1.0f);
    }
  }
  return out;
}

double rms_error(const Image<glm::vec4>& light, const Image<double>& truth) {
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.texels().size(); ++i) {
    const double e = static_cast<double>(light.data()[i].x) - truth.data()[i];
    squares += e * e;
  }
  return std::sqrt(squares / static_cast<double>(truth.texels().size()));
}

double deepest_chord(const Mesh& mesh, double radius) {
  double deepest = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
    const glm::dvec3 n = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
    deepest = std::max(deepest, radius - std::abs(glm::dot(n, at(0))));
  }
  return deepest;
}

}  // namespace halfspace
