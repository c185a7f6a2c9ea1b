// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/shadow/shadow_blocks.h"

#include <algorithm>
#include <vector>

namespace halfspace::HS_LANES {

Image<float> shadow_block_depths(const Image<float>& depth, const Workers& workers) {
  const int size = depth.width(), side = shadow_blocks_per_side(size);
  HS_CHECK_OP(depth.height(), ==, size, "shadow map: the depths are not square; expected a height equal to the width");
  Image<float> largest(side, side);
  workers.for_each(side, [&](int block_row) {
    std::vector<float> column(static_cast<std::size_t>(size));  // the largest depth of each column of texels
    const int first = block_row * kShadowBlock;
    for (int j = first; j < std::min(first + kShadowBlock, size); ++j)  // the top row of texels is stored first
      std::ranges::transform(column, depth.row(size - 1 - j), column.begin(), [](float a, float b) { return std::max(a, b); });
    for (int x = 0; x < size; ++x) {
      float& block = largest.at(x / kShadowBlock, block_row);
      block = std::max(block, column[static_cast<std::size_t>(x)]);
    }
  });
  Image<float> window(side, side);
  workers.for_each(side, [&](int y) {
    const int above = std::min(y + 1, side - 1);
    for (int x = 0; x < side; ++x) {
      const int right = std::min(x + 1, side - 1);
      window.at(x, y) = std::max({largest.at(x, y), largest.at(right, y), largest.at(x, above), largest.at(right, above)});
    }
  });
  return window;
}

}  // namespace halfspace::HS_LANES
