// SPDX-License-Identifier: Apache-2.0
//
// Procedural materials as square maps that tile in both directions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

/// Content of a pattern, with v pointing down:
///   checkerboard  8 x 8 squares, white in the first corner
///   grass         a meadow seen from above
///   bark          ridges along v
///   bricks        4 x 8 bricks in running bond
///   facade        4 x 4 windows, some of them lit
///   rock          weathered stone
///   hills         heights of a landscape, also as a gray color map
enum class Pattern : uint8_t { checkerboard, grass, bark, bricks, facade, rock, hills };

/// The maps of a pattern, all square and of the same size, with row 0 at the top. Maps that a pattern does not use are constant.
struct PatternMaps {
  Image<glm::u8vec4> color;     ///< sRGB values, alpha 255
  Image<glm::u8vec4> specular;  ///< gray specular factor, value/255: 0 for diffuse surfaces; highest on glass
  Image<glm::u8vec4> emissive;  ///< sRGB values of the light emitted at night: black except for lit windows
  Image<uint16_t> height;       ///< 0 (low) to 65535 (high)
};

/// Range of the widths that scenes choose automatically.
inline constexpr int kMinPattern = 64, kMaxPattern = 2048;

/// Generates the maps of a pattern with `width` x `width` texels, width ≥ 1. Apart from sharp edges, they contain no detail finer than two
/// texels. The result depends, bit for bit, only on the pattern and the width.
PatternMaps procedural_pattern(Pattern pattern, int width, const Workers& workers);

}  // namespace halfspace::HS_LANES
