// SPDX-License-Identifier: Apache-2.0
//
// Attachments of a pass, and the buffers that hold their contents if the bins are flushed before the end of the pass.
#pragma once

#include <vector>

#include "halfspace/raster/target.h"
#include "halfspace/raster/tile/post_step.h"

namespace halfspace::HS_LANES {

struct Attachments {
  std::vector<ColorTarget> colors;
  DepthTarget depth;
  bool has_color = false;  ///< at least one color attachment has a format
  PostStep post;
  // Values between flushes of attachments that are not stored in an image or have several samples per pixel.
  std::vector<std::vector<std::byte>> color_spills;
  std::vector<std::byte> depth_spill;
};

/// One iteration over all tiles. A pass has several rounds if the bins exceed their budget.
struct Round {
  bool first, last;
};

}  // namespace halfspace::HS_LANES
