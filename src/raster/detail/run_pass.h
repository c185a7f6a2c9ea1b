// SPDX-License-Identifier: Apache-2.0
//
// Runs a pass with other code in place of the drawing of its tiles.
#pragma once

#include "halfspace/raster/loop/tile_worker.h"

namespace halfspace::HS_LANES {

class Pass;

/// Runs a pass like Pass::run(), but calls tiles.run() in each round instead of drawing the tiles. The pass must have one layer.
PassStatistics run_with(Pass& pass, TileRunner& tiles, const Workers& workers);

/// The same, but the triangles of the last round, the shaded vertices and the draws stay in memory. No draw may have emitting stages.
PassStatistics run_and_keep_triangles(Pass& pass, TileRunner& tiles, const Workers& workers);
/// Must be called once after run_and_keep_triangles(). Returns what it kept to the pool.
void release_triangles(Pass& pass);

/// What a pass has recorded. Valid as long as the pass or the one that it is moved to.
struct RecordedPass {
  const PassContext& context;  ///< the draws, without the results of any stage
  const Attachments& attachments;
  int layers;
};
RecordedPass recorded_pass(const Pass& pass);

}  // namespace halfspace::HS_LANES
