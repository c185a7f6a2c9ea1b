// SPDX-License-Identifier: Apache-2.0
//
// Runs a pass. Input: its draws and its plan. Output: the images. The vertices are shaded, and the chunks are set up and binned; then the
// tiles are drawn. If the triangles exceed the memory limit, this is repeated in several rounds.
#pragma once

#include "halfspace/raster/loop/pass_plan.h"
#include "halfspace/raster/loop/tile_worker.h"
#include "halfspace/raster/pipeline/pass_memory.h"

namespace halfspace::HS_LANES {

/// Runs all rounds of a pass and returns its statistics. The chunks and shaded vertices of the last round stay in the context until
/// release_rounds() is called. spare: receives memory that no round needed.
/// budget: see PassTuning::bin_budget.
PassStatistics run_rounds(PassContext& context, Attachments& attachments, PassPlan plan, std::size_t budget, TileRunner& tiles,
                          const Workers& workers, PassMemory& spare);

/// Returns the chunks and shaded vertices of the context, and the spare memory, to the pool.
void release_rounds(PassContext& context, PassMemory spare);

}  // namespace halfspace::HS_LANES
