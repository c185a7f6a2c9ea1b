// SPDX-License-Identifier: Apache-2.0
//
// Memory of finished passes, kept for reuse. The buffers of a pass are large, and the operating system would have to clear every page of
// newly allocated ones. In a profile of a pass with a million small triangles, this took about a sixth of the time.
#pragma once

#include <memory>
#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Buffers of a pass. Their contents are unspecified.
struct PassMemory {
  std::vector<Chunk> chunks;
  std::vector<ShadedVertices> shaded;
};

/// Draws, and the arena that they use.
struct DrawList {
  std::unique_ptr<DrawArena> arena;
  std::vector<Draw> draws;
};

/// Takes a recycled draw list from the pool, and returns one to it. This is separate from PassMemory, because a pass adds draws before it
/// runs. The list is empty; if the pool is, it has a new arena. Thread-safe.
DrawList take_draw_list();
void return_draw_list(DrawList list);

/// Takes recycled memory from the pool; returns empty buffers if there is none. Thread-safe.
PassMemory take_pass_memory();

/// Returns memory to the pool. The pool has at most 512 MB: to make room for what is returned, it frees the pass memory that was returned
/// first. Memory that exceeds the limit by itself is freed at once.
void return_pass_memory(PassMemory memory);

}  // namespace halfspace::HS_LANES
