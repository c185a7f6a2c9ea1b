// SPDX-License-Identifier: Apache-2.0
//
// Bin. In: a chunk's triangles. Out: for each tile of the chunk the triangles that may touch it, in submission order.
#pragma once

#include <span>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// Fills the bins of a chunk: list (tile, triangle) pairs, count them by tile, prefix sum, fill.
void bin_chunk(const PassContext& context, Chunk& chunk);

/// The triangles of one tile, empty where the chunk has none there.
std::span<const uint16_t> bin_of(const Chunk& chunk, int tile_x, int tile_y);

}  // namespace halfspace
