// SPDX-License-Identifier: Apache-2.0
//
// Draws all primitives of a tile, in submission order.
#pragma once

#include "halfspace/raster/shade/tile_memory.h"

namespace halfspace::HS_LANES {

/// Draws the primitives in the bins of a tile. The tile must be loaded. has_color: the pass has a color attachment.
/// trace: records the fragments, unless it is null.
void draw_tile(const PassContext& context, bool has_color, int tile_x, int tile_y, TileMemory& memory, PassStatistics& statistics,
               TileTrace* trace);

}  // namespace halfspace::HS_LANES
