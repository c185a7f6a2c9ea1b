// SPDX-License-Identifier: Apache-2.0
//
// Colors of PLY files.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/model/ply/ply_header.h"

namespace halfspace::HS_LANES {

/// The colors of an element as written: red, green, blue and opacity.
struct PlyColors {
  std::vector<glm::vec4> values;  ///< NaN: not finite
  std::array<PlyType, 4> types{PlyType::uint8, PlyType::uint8, PlyType::uint8, PlyType::uint8};
};

/// Returns the linear colors, and clears the argument. All types hold sRGB-encoded values, as 8-bit colors do. The values decide on their
/// range: floating-point colors are from 0 to 1, or from 0 to 255 if a value exceeds 1. Colors of all types are from 0 to 65535 if a value
/// exceeds 255. The range is that of red, green and blue together; opacity has its own. Colors that are not finite become white.
/// replaced: receives their number.
std::vector<glm::vec4> linear_ply_colors(PlyColors& colors, std::size_t& replaced);

}  // namespace halfspace::HS_LANES
