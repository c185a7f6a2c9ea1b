// SPDX-License-Identifier: Apache-2.0
//
// Setup. In: a chunk's segments of index lists, and the shaded vertices. Out: Chunk::triangles (culled, clipped where
// needed, wound counter-clockwise, with their depth coefficients; points and lines too), clip vertices and statistics.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// Fills chunk.triangles from chunk.segments.
void set_up_chunk(const PassContext& context, Chunk& chunk);

/// Entries of Chunk::triangles that one primitive of a draw becomes, at the most.
uint32_t max_triangles_per_primitive(const Draw& draw, int samples);

}  // namespace halfspace
