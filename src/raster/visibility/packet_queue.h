// SPDX-License-Identifier: Apache-2.0
//
// Queue of packets to shade: packets of consecutive triangles of one draw in a tile, in submission order. A batch can contain packets of
// several triangles, so the shader runs on full batches even if triangles are small.
#pragma once

#include "halfspace/raster/visibility/packet_batch.h"

namespace halfspace {

/// Used for draws with one sample per pixel. The VisibilityMode of the draw determines whether the packets have passed the depth test.
struct PacketQueue {
  /// If the queue contains at least this many packets, it must be shaded before a triangle is added. The arrays have room for the packets
  /// of one more triangle and for one element after the last one.
  static constexpr int kShadeAt = 64;
  static constexpr std::size_t kCapacity = kShadeAt + kPackets + 1;

  bool is_full() const { return count >= kShadeAt; }
  /// Returns n packets for a kernel, starting with packet `begin`.
  PacketBatch batch(const PassContext& context, const Tile& tile, std::size_t begin, std::size_t n) const {
    return {.context = &context,
            .tile_x0 = tile.x0,
            .tile_y0 = tile.y0,
            .packet_ids = &ids[begin],
            .packets = &packets[begin],
            .count = static_cast<int>(n)};
  }

  int count = 0;
  std::array<PacketMask, kCapacity> packets;
  std::array<TriangleId, kCapacity> ids;
  /// Depth of the triangle, represented as in Tile::depth. Not valid for VisibilityMode::early and cover_only.
  alignas(64) std::array<Real, kCapacity> depth;
};

}  // namespace halfspace
