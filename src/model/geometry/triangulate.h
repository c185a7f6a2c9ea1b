// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of polygons.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Appends the triangles of a simple polygon, possibly concave and not quite planar, as indices into `corners`, with the winding of the
/// polygon. A polygon with n vertices gives n − 2 triangles. It is projected along a coordinate axis and cut by ear clipping with exact
/// tests. A polygon that intersects itself gets n − 2 triangles that cover only part of it.
void triangulate(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles);

}  // namespace halfspace::HS_LANES
