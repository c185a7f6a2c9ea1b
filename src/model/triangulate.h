// SPDX-License-Identifier: Apache-2.0
//
// Triangulation of polygons.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace halfspace {

/// Appends the triangles of a simple polygon, possibly concave and not quite planar, as indices into `corners`, with the winding of the
/// polygon. A polygon of n corners gives n − 2 triangles. It is projected along its mean normal and cut by ear clipping, with exact tests
/// where that is possible. A polygon that intersects itself gets n − 2 triangles that cover it only in part.
void triangulate(std::span<const glm::dvec3> corners, std::vector<uint32_t>& triangles);

}  // namespace halfspace
