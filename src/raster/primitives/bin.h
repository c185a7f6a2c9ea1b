// SPDX-License-Identifier: Apache-2.0
//
// Binning. Input: the triangles of a chunk. Output: for each tile, the triangles that may touch it, in submission order.
#pragma once

#include <span>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Fills the bins of a chunk: lists (tile, triangle) pairs, counts them per tile, computes a prefix sum and copies the triangles.
void bin_chunk(const PassContext& context, Chunk& chunk);

/// Returns the triangles of one tile, or an empty span if the chunk has none there.
std::span<const uint16_t> bin_of(const Chunk& chunk, int tile_x, int tile_y);

}  // namespace halfspace::HS_LANES
