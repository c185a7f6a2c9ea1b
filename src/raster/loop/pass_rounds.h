// SPDX-License-Identifier: Apache-2.0
//
// Runs a pass. Input: its draws and its plan. Output: the images. The vertices are shaded, and the chunks are set up and binned; then the
// tiles are drawn. If the triangles exceed the memory limit, this is repeated in several rounds.
#pragma once

#include "halfspace/raster/loop/pass_plan.h"
#include "halfspace/raster/loop/tile_worker.h"

namespace halfspace::HS_LANES {

/// Runs all rounds of a pass and returns its statistics. The chunks and shaded vertices of the context are only valid in tiles.run().
/// budget: see PassTuning::bin_budget.
PassStatistics run_rounds(PassContext& context, Attachments& attachments, PassPlan plan, std::size_t budget, TileRunner& tiles,
                          const Workers& workers);

}  // namespace halfspace::HS_LANES
