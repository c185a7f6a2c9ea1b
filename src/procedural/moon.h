// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

/// Equirectangular maps in the layout of uv_sphere: row 0 is the north, and the center of the map is the center of the near side.
struct MoonMaps {
  Image<glm::u8vec4> color;  // 8-bit sRGB, alpha 255, without shading
  Image<uint16_t> height;    // 0 to 65535 map to −10 km to 10 km relative to the mean radius of 1737.4 km
};

/// Returns a procedural Moon. Maria and large young craters are placed as on the real Moon. Craters range from walled plains to
/// bowls of one or two texels; young ones have bright rays. Everything is computed on the sphere, so there is no seam and the poles
/// are not pinched. A wider map shows the same Moon with additional small craters. `width` must be even and ≥ 2; the height is
/// width / 2. The result depends only on the width, bit for bit.
MoonMaps procedural_moon(int width, const Workers& workers);

}  // namespace halfspace::HS_LANES
