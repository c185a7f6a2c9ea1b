// SPDX-License-Identifier: Apache-2.0
//
// Tile worker: all per-tile work of a pass. Input: the triangles of the pass after setup, and its attachments. Output: the images. Each
// tile is loaded or cleared, drawn, resolved, stored, and passed to the post step.
#pragma once

#include <span>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"
#include "halfspace/raster/trace/fragment_trace.h"

namespace halfspace::HS_LANES {

/// Allocates the buffers that hold the attachments between rounds.
void keep_between_flushes(const PassContext& context, Attachments& attachments);

/// What to record about the tiles of a round.
struct TileRecords {
  /// Unless it is null, the round is added to it. The draw, instance and primitive of the fragments are not set. Tiles with a constant
  /// color are drawn like all others.
  PassTrace* trace = nullptr;
  /// Unless it is empty, the time of each tile in milliseconds is added to it, row by row from the lower left.
  std::span<float> ms = {};
};

/// Runs all tiles of one round.
void run_tiles(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers, PassStatistics& statistics,
               const TileRecords& records = {});

/// Runs one tile of a pass that has a single round.
void run_single_tile(const PassContext& context, const Attachments& attachments, int tile_x, int tile_y, PassStatistics& statistics);

/// Runs the tiles of each round of a pass.
class TileRunner {
 public:
  virtual ~TileRunner() = default;
  /// Returns true if run() reads the primitive numbers of all draws.
  virtual bool inspects_primitives() const { return false; }
  virtual void run(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers,
                   PassStatistics& statistics) = 0;
};

}  // namespace halfspace::HS_LANES
