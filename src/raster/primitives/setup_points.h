// SPDX-License-Identifier: Apache-2.0
//
// Setup of points: those of point draws, and those of triangles with PolygonMode::point. Output: elements of Chunk::triangles.
#pragma once

#include "halfspace/raster/primitives/setup_range.h"

namespace halfspace::HS_LANES {

/// Sets up the next `count` points of a draw range.
void set_up_points(SetupRange& range, uint32_t count);

/// Appends a point. id: its vertex slot, or with kClipped in flags the index of its clip vertex.
Cull append_point(SetupRange& range, const PointSpriteRect& rect, const ScreenVertex& v, uint32_t id, uint32_t flags, Facing facing);

}  // namespace halfspace::HS_LANES
