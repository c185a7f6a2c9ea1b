// SPDX-License-Identifier: Apache-2.0
//
// Appends lines to Chunk::triangles: those of line draws, and the edges of triangles with PolygonMode::line.
#pragma once

#include "halfspace/raster/primitives/setup_range.h"

namespace halfspace::HS_LANES {

/// Appends the line between two snapped vertices, for passes with one sample per pixel. index: their vertex slots, or with kClipped in
/// flags the indices of clip vertices. provoking: 0 or 1, the vertex whose flat varyings the line has.
Cull append_line(SetupRange& range, const std::array<const ScreenVertex*, 2>& v, const std::array<uint32_t, 2>& index, uint32_t flags,
                 uint32_t provoking, Facing facing);

/// Appends the line between two clip vertices. If the pass is multisampled, the line is a rectangle of two triangles.
Cull append_clip_line(SetupRange& range, uint32_t a, uint32_t b, Facing facing);

/// Returns true if append_outline() can append the edges of the draw's unclipped triangles.
bool can_append_outlines(const SetupRange& range);
/// Sets up the edges of a triangle that needs no clipping. If all varyings are finite, the result is that of set_up_clipped(), which would
/// copy the vertices.
void append_outline(SetupRange& range, const PrimitiveSlots& slots);

}  // namespace halfspace::HS_LANES
