// SPDX-License-Identifier: Apache-2.0
//
// Packets of consecutive triangles of one draw in a tile, in submission order, that wait for the shader. Batches of the queue contain
// packets of several triangles, so that the shader runs on full batches even if triangles are small.
#pragma once

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// Used for draws with one sample per pixel. Whether the packets have passed the depth test depends on the VisibilityMode of the draw.
struct PacketQueue {
  /// The queue must be shaded before a triangle is added to this many packets or more. It has room for one more triangle and the element
  /// after the last one.
  static constexpr int kShadeAt = 64;
  static constexpr std::size_t kCapacity = kShadeAt + kPackets + 1;

  bool is_full() const { return count >= kShadeAt; }

  int count = 0;
  std::array<PacketMask, kCapacity> packets;
  std::array<TriangleId, kCapacity> ids;
  /// Depth of the triangle, represented as in Tile::depth. Not valid for VisibilityMode::early and cover_only.
  alignas(64) std::array<Real, kCapacity> depth;
};

}  // namespace halfspace
