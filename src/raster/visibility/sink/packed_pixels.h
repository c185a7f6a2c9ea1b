// SPDX-License-Identifier: Apache-2.0
//
// Moves the pixels of sparsely covered packets together, so that the shader runs on full packets. A small triangle covers only some of the
// pixels of its packets: with 8 lanes, a triangle of 30 pixels covers about half of them. Results do not depend on the lane in which they
// are computed, so the image is the same.
#pragma once

#include <bit>
#include <span>

#include "halfspace/core/lane_packing.h"
#include "halfspace/raster/visibility/sink/packet_batch.h"

namespace halfspace::HS_LANES {

struct Draw;

/// Covered pixels of consecutive packets of one draw that is shaded per pixel, in their order.
struct PackedPixels {
  static constexpr std::size_t kCapacity = kPacketBatch * kLanes;

  std::size_t count = 0;
  std::array<PacketMask, kPacketBatch> packets;                ///< all are full, except for the last
  alignas(64) std::array<int32_t, kCapacity + kLanes> pixels;  ///< see PacketBatch::pixels
  alignas(64) std::array<TriangleId, kCapacity + kLanes> ids;  ///< of each pixel

  int packet_count() const { return static_cast<int>((count + kLanes - 1) / kLanes); }
  /// Returns the packets for a kernel that evaluates the shader at pixel centers.
  PacketBatch batch(const PassContext& context, const Tile& tile) const;
};

/// Returns the number of pixels in packets.
inline std::size_t pixel_count(std::span<const PacketMask> packets) {
  std::size_t pixels = 0;
  for (const PacketMask& p : packets) pixels += static_cast<std::size_t>(std::popcount(p.lanes));
  return pixels;
}

/// Returns true if the pixels of a draw can be packed. Returns false for draws with a constant shader, and if the kernels need the
/// positions of centroid varyings or return sample masks.
bool can_pack(const Draw& draw, const Tile& tile);

/// Returns true if packing saves at least a quarter of the packets.
bool pays_to_pack(std::span<const PacketMask> packets);

/// Returns true if the packets of a queue should be packed. Returns false for points: a queue lists overlapping points in separate packets,
/// so no values are gathered.
bool packs_queue(const Draw& draw, const Tile& tile, std::span<const PacketMask> packets);

/// Packs the pixels of as many packets as fit, from the start of the list. ids: the triangle of each packet. Returns the number of these
/// packets, which is at least kPacketBatch if the list has that many.
std::size_t pack(std::span<const PacketMask> packets, const TriangleId* ids, PackedPixels& out);

/// The same for packets of visible pixels. ids: the triangle of each pixel of the tile's storage; tile_size: Tile::size.
std::size_t pack_visible(std::span<const PacketMask> packets, const TriangleId* ids, int tile_size, PackedPixels& out);

/// Returns the keep mask of a packet with the given lanes, from the masks of packed ones. first: number of the first pixel of the packet.
/// Reads one element after the last packed packet.
uint16_t unpack_keep(const uint16_t* packed, std::size_t first, uint32_t lanes);

/// The same for floats, such as depths. Reads W of them.
HS_INLINE Real unpack_values(const float* packed, std::size_t first, uint32_t lanes) {
  return unpack_lanes(load<Real>(packed + first), lanes);
}

}  // namespace halfspace::HS_LANES
