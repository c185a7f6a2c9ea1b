// SPDX-License-Identifier: Apache-2.0
//
// Tile worker: everything that a pass does tile by tile. In: the set-up triangles of a pass and its attachments. Out: the images: for each
// tile load or clear, draw, resolve, post step, store.
#pragma once

#include "halfspace/core/parallel.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace {

/// Makes the spills that hold the attachments from one round to the next.
void keep_between_flushes(const PassContext& context, Attachments& attachments);

/// Runs all tiles of one round.
void run_tiles(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers, PassStatistics& statistics);

}  // namespace halfspace
