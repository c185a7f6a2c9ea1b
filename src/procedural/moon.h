// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// Equirectangular maps laid out as uv_sphere's: row 0 is the north, the middle of the map the middle of the near side.
struct MoonMaps {
  Image<glm::u8vec4> color;  // sRGB codes, alpha 255, without light and shade
  Image<uint16_t> height;    // 0 to 65535 is −10 km to 10 km above the mean sphere of 1737.4 km
};

/// An invented Moon whose seas and great young craters lie as the Moon's: craters of all sizes down to a texel or two, bowls
/// and walled plains, maria, bright rays. All is computed on the sphere, so there is no seam and no pinch at the poles. A wider
/// map shows the same Moon with more small craters. `width` ≥ 2 and even, the height is half of it. The bits depend on the
/// width alone.
MoonMaps procedural_moon(int width, const Workers& workers);

}  // namespace halfspace
