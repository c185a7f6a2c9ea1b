// SPDX-License-Identifier: Apache-2.0
//
// Memory of finished passes, kept for the next: a frame's buffers are large, and the operating system would have to clear
// every page of them anew (a profile of a million small triangles: some sixth of the samples).
#pragma once

#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// The buffers of a pass. What they hold means nothing.
struct PassMemory {
  std::vector<Chunk> chunks;
  std::vector<ShadedVertices> shaded;
};

/// Memory of a finished pass's list of draws, empty; and its keeping, as below. A pass fills its list before it runs.
std::vector<Draw> take_draw_list();
void return_draw_list(std::vector<Draw> draws);

/// Memory of a finished pass, or empty. Any number of threads may ask.
PassMemory take_pass_memory();

/// Keeps the memory if what is kept stays below 256 MB, else frees it.
void return_pass_memory(PassMemory memory);

}  // namespace halfspace
