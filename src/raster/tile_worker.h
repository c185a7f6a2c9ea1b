// SPDX-License-Identifier: Apache-2.0
//
// Tile worker: all per-tile work of a pass. Input: the triangles of the pass after setup, and its attachments. Output: the images. Each
// tile is loaded or cleared, drawn, resolved, stored, and passed to the post step.
#pragma once

#include "halfspace/core/parallel.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace {

/// Allocates the buffers that hold the attachments between rounds.
void keep_between_flushes(const PassContext& context, Attachments& attachments);

/// Runs all tiles of one round.
void run_tiles(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers, PassStatistics& statistics);

}  // namespace halfspace
