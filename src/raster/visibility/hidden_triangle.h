// SPDX-License-Identifier: Apache-2.0
//
// Rejects small triangles with hierarchical Z.
#pragma once

#include "halfspace/raster/visibility/block_edges.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_plane.h"
#include "halfspace/raster/visibility/visibility.h"

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

/// Returns true if the depth bounds of the blocks show that no fragment of a triangle can pass. Triangles that may cover only a few pixels
/// are not tested. rect: the pixels that may be covered, in one sample plane of the tile.
template <class Writer>
bool is_hidden(const DrawInTile& d, const Triangle& t, const TileRect& rect, const Writer& writer) {
  if (!writer.tests() || rect.empty() || (rect.x1 - rect.x0) * (rect.y1 - rect.y0) < kManyPixels) return false;
  const DepthBounds z = depth_bounds(t, d.draw, d.tile.depth_format);
  const CompareOp op = writer.compare_op();
  return all_blocks(rect, [&](int block) { return test_block(op, d.tile, block, z.low, z.high) == BlockTest::none_passes; });
}

/// Reports the blocks of a hidden triangle to the writer. rect: as above, in the plane of the sample.
template <class Writer>
void report_hidden(const DrawInTile& d, const Triangle& t, TriangleId id, const TileRect& rect, std::size_t sample, const Writer& writer) {
  const DepthBounds z = depth_bounds(t, d.draw, d.tile.depth_format);
  all_blocks(rect, [&](int block) {
    writer.block_rejected(t, id, sample, block, z);
    return true;
  });
}

}  // namespace halfspace::HS_LANES
