// SPDX-License-Identifier: Apache-2.0
//
// Memory of finished passes, kept for the next: a frame's buffers are large, and the operating system would have to clear
// every page of them anew (a profile of a million small triangles: some sixth of the samples).
#pragma once

#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// The buffers of a pass. What they hold means nothing.
struct FrameMemory {
  std::vector<Chunk> chunks;
  std::vector<ShadedVertices> shaded;
};

/// Memory of a finished pass's list of draws, empty; and its keeping, as below. A pass fills its list before it runs.
std::vector<Draw> take_draw_memory();
void keep_draw_memory(std::vector<Draw> draws);

/// Memory of a finished pass, or empty. Any number of threads may ask.
FrameMemory take_frame_memory();

/// Keeps the memory if what is kept stays below 256 MB, else frees it.
void keep_frame_memory(FrameMemory memory);

}  // namespace halfspace
