// SPDX-License-Identifier: Apache-2.0
//
// Index lists of glTF primitives.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// The values of primitive.mode.
enum class GltfMode : uint8_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

MeshTopology topology_of(GltfMode mode);

/// Converts strips, loops and fans into lists. Incomplete lines and triangles at the end are dropped.
std::vector<uint32_t> list_of_primitives(GltfMode mode, std::vector<uint32_t> indices);

}  // namespace halfspace::HS_LANES
