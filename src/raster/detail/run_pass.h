// SPDX-License-Identifier: Apache-2.0
//
// Runs of a pass whose tiles are drawn by others.
#pragma once

#include "halfspace/raster/loop/tile_worker.h"

namespace halfspace::HS_LANES {

class Pass;

/// Runs a pass like Pass::run(), but calls tiles.run() in each round instead of drawing the tiles. The pass must have one layer.
PassStatistics run_with(Pass& pass, TileRunner& tiles, const Workers& workers);

/// The same, but the triangles of the last round and the vertices stay in memory until release() is called. No draw may have emitting
/// stages.
PassStatistics run_and_keep(Pass& pass, TileRunner& tiles, const Workers& workers);
void release(Pass& pass);

}  // namespace halfspace::HS_LANES
