// SPDX-License-Identifier: Apache-2.0
//
// What a pass draws into, and what holds its values when the bins are flushed before the end of the pass.
#pragma once

#include <vector>

#include "halfspace/raster/target.h"
#include "halfspace/raster/tile/post_step.h"

namespace halfspace {

struct Attachments {
  std::vector<ColorTarget> colors;
  DepthTarget depth;
  bool has_color = false;  ///< some colour attachment has a format
  PostStep post;
  // From flush to flush these hold what no image can: a target without one, or several samples per pixel.
  std::vector<std::vector<std::byte>> color_spills;
  std::vector<std::byte> depth_spill;
};

/// One run over all tiles. There are several where the bins outgrow their budget.
struct Round {
  bool first, last;
};

}  // namespace halfspace
