// SPDX-License-Identifier: Apache-2.0
//
// Setup. Input: the draw ranges of a chunk and the shaded vertices. Output: Chunk::triangles, clip vertices and statistics. Triangles are
// culled, clipped if necessary, and put in counter-clockwise order; then their depth coefficients are computed. Points and lines are
// handled here as well.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Fills chunk.triangles from chunk.ranges.
void set_up_chunk(const PassContext& context, Chunk& chunk);

/// Returns the maximum number of elements of Chunk::triangles that one primitive of a draw can become.
uint32_t max_triangles_per_primitive(const Draw& draw, int samples);

}  // namespace halfspace::HS_LANES
