// SPDX-License-Identifier: Apache-2.0
//
// Materials that tile: square maps whose left and right, upper and lower edges meet.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// What is shown, v downwards:
///   checkerboard  8 x 8 squares, the first white, black beside it
///   grass         a meadow from above
///   bark          ridges along v
///   bricks        4 x 8 bricks in running bond
///   facade        4 x 4 windows, some with light behind them
///   rock          weathered stone
///   hills         heights of a landscape, as a grey map too
enum class Pattern : uint8_t { checkerboard, grass, bark, bricks, facade, rock, hills };

/// Row 0 is the top. All maps are square and of one size; those that a pattern does not have are one value everywhere.
struct PatternMaps {
  Image<glm::u8vec4> color;     ///< sRGB codes, alpha 255
  Image<glm::u8vec4> specular;  ///< grey factor of highlights, code/255: 1 for glass, 0 for what is dull
  Image<glm::u8vec4> emissive;  ///< sRGB codes of the light at night: black but for lit windows
  Image<uint16_t> height;       ///< 0 to 65535, low to high
};

/// The widths that a scene gives patterns by itself.
inline constexpr int kMinPattern = 64, kMaxPattern = 2048;

/// Makes a pattern's maps of `width` x `width` texels, width ≥ 1; nothing in them is finer than two texels, but for sharp
/// edges. The bits depend on pattern and width alone.
PatternMaps procedural_pattern(Pattern pattern, int width, const Workers& workers);

}  // namespace halfspace
