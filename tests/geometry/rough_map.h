// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "halfspace/core/image.h"

namespace halfspace {

/// Returns pseudo-random heights in [0, 1) without spatial correlation.
inline Image<float> rough_map(int width, int height, uint32_t seed) {
  Image<float> map(width, height);
  for (int y = 0; y < height; ++y) {
    for (float& t : map.row(y)) {
      seed = seed * 1664525u + 1013904223u;
      t = static_cast<float>(seed >> 8) * 0x1p-24f;
    }
  }
  return map;
}

}  // namespace halfspace
