// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene with the renderer and with the naive pipeline, in float or double, for comparison.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

inline Image<glm::u8vec4> picture_of(const SceneDescription& scene, int width, int height, int threads = 2) {
  const Workers workers(threads);
  SceneAssets assets(workers);
  Image<glm::u8vec4> picture(width, height);
  render(assets.prepare(scene, width, height), picture, workers);
  return picture;
}

/// Renders the same image in linear color, before exposure.
inline Image<glm::vec4> light_of(const SceneDescription& scene, int width, int height, SceneAssets& assets, const Workers& workers) {
  Image<glm::vec4> picture(width, height);
  render(assets.prepare(scene, width, height), picture, workers);
  return picture;
}
inline Image<glm::vec4> light_of(const SceneDescription& scene, int width, int height) {
  const Workers workers(2);
  SceneAssets assets(workers);
  return light_of(scene, width, height, assets, workers);
}

/// Vertex positions of the double twin: computed in double, or in float arithmetic. With the latter, all vertices snap to the same
/// positions as in the renderer, so only shading is compared.
enum class Positions { in_r, as_rendered };

/// Renders the scene with the naive pipeline in R, float or double. The result is linear color, top row first. Defined in
/// naive_picture.cpp, so that the shaders of all scenes are compiled only there.
template <class R>
Image<vec4<R>> naive_picture(const PreparedScene& scene, int width, int height, Positions positions = Positions::in_r);
template <>
Image<vec4<float>> naive_picture<float>(const PreparedScene& scene, int width, int height, Positions positions);
template <>
Image<vec4<double>> naive_picture<double>(const PreparedScene& scene, int width, int height, Positions positions);

template <class R>
Image<vec4<R>> naive_picture(const SceneDescription& scene, int width, int height) {
  const Workers workers(2);
  SceneAssets assets(workers);
  return naive_picture<R>(assets.prepare(scene, width, height), width, height);
}

/// Returns the surface parameters of the draw's shader, which must be derived from LitSurface.
inline const LitSurface& surface_of(const PreparedDraw& draw) {
  const LitSurface* surface = nullptr;
  std::visit(
      [&](const auto& shader) {
        if constexpr (std::is_base_of_v<LitSurface, std::decay_t<decltype(shader)>>) surface = &shader;
      },
      draw.shader);
  HS_CHECK(surface != nullptr);
  return *surface;
}

inline int largest_difference(glm::u8vec4 a, glm::u8vec4 b) {
  int d = 0;
  for (int k = 0; k < 4; ++k) d = std::max(d, std::abs(int{a[k]} - int{b[k]}));
  return d;
}

template <class R>
glm::u8vec4 encode(const vec4<R>& c) {
  glm::u8vec4 out;
  for (int k = 0; k < 3; ++k) out[k] = static_cast<uint8_t>(linear_to_srgb(static_cast<float>(c[k])));
  out[3] = static_cast<uint8_t>(linear_to_unorm8(static_cast<float>(c[3])));
  return out;
}

/// Returns the fraction of pixels that differ by more than 1/255 from the naive pipeline in R.
template <class R>
double share_beyond_one_code(const SceneDescription& scene, int width, int height) {
  const Image<glm::u8vec4> image = picture_of(scene, width, height);
  const Image<vec4<R>> truth = naive_picture<R>(scene, width, height);
  int beyond = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) beyond += largest_difference(image.at(x, y), encode<R>(truth.at(x, y))) > 1;
  }
  return beyond / (static_cast<double>(width) * height);
}

}  // namespace halfspace
