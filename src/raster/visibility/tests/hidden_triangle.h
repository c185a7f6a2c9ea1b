// SPDX-License-Identifier: Apache-2.0
//
// Rejects small triangles with hierarchical Z.
#pragma once

#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/visibility/tests/depth_bounds.h"

namespace halfspace::HS_LANES {

/// Returns true if f(block) returns true for all blocks of the tile that overlap a rectangle. Stops at the first that does not.
template <class F>
HS_INLINE bool all_blocks(const TileRect& rect, const F& f) {
  for (int y = rect.y0 / kBlockSize; y <= (rect.y1 - 1) / kBlockSize; ++y) {
    for (int x = rect.x0 / kBlockSize; x <= (rect.x1 - 1) / kBlockSize; ++x) {
      if (!f(y * kBlocksPerRow + x)) return false;
    }
  }
  return true;
}

/// Returns true if the depth bounds of the blocks show that no depth in [z.low, z.high] passes the test `op`. rect: pixels of the tile's
/// storage.
inline bool is_hidden(CompareOp op, Tile& tile, const TileRect& rect, const DepthBounds& z) {
  return all_blocks(rect, [&](int block) { return test_block(op, tile, block, z) == BlockTest::none_passes; });
}

}  // namespace halfspace::HS_LANES
