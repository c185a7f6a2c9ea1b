// SPDX-License-Identifier: Apache-2.0
//
// Setup of points and lines: those of point and line draws, and those of triangles with a polygon mode other than fill. Output: elements of
// Chunk::triangles.
#pragma once

#include "halfspace/raster/primitives/setup_range.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Sets up the next `count` points or lines of a draw range.
void set_up_points(SetupRange& range, uint32_t count);
void set_up_lines(SetupRange& range, uint32_t count);

/// Returns true if append_outline() can append the edges of the draw's unclipped triangles.
bool can_append_outlines(const SetupRange& range);
/// Sets up the edges of a triangle that needs no clipping. If all varyings are finite, the result is that of set_up_clipped(), which would
/// copy the vertices.
void append_outline(SetupRange& range, const PrimitiveSlots& slots);

/// Appends a point. id: its vertex slot, or with kClipped in flags the index of its clip vertex.
Cull append_point(SetupRange& range, const PointSpriteRect& rect, const ScreenVertex& v, uint32_t id, uint32_t flags, Facing facing);

/// Appends the line between two clip vertices. If the pass is multisampled, the line is a rectangle of two triangles.
Cull append_clip_line(SetupRange& range, uint32_t a, uint32_t b, Facing facing);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
