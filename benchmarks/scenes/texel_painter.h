// SPDX-License-Identifier: Apache-2.0
//
// Shared by the texture generators of the scenes.
#pragma once

#include <algorithm>
#include <cmath>

#include "scenes/scene_textures.h"

namespace halfspace {

/// Returns tileable noise, roughly in [−1, 1], with the given number of cells along each axis.
Image<float> noise_map(TexelSize size, glm::ivec2 cells, int octaves, int seed);

inline float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}
inline float fraction(float x) { return x - std::floor(x); }

/// Returns a number in [0, 1) that depends on two integers and a seed.
float cell_value(int i, int j, int seed);

inline glm::u8vec4 texel_code(glm::vec4 color) { return glm::u8vec4(glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// Calls color(x, y, u, v) for every texel; (u, v) is its center. color returns a vec3, or a vec4 with alpha.
template <class F>
SceneTexels paint(TexelSize size, const F& color) {
  SceneTexels image(size.width, size.height);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size.width);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height);
      if constexpr (std::is_same_v<decltype(color(x, y, u, v)), glm::vec3>) {
        image.at(x, y) = texel_code(glm::vec4(color(x, y, u, v), 1.0f));
      } else {
        image.at(x, y) = texel_code(color(x, y, u, v));
      }
    }
  }
  return image;
}

}  // namespace halfspace
