// SPDX-License-Identifier: Apache-2.0
//
// Queue of packets to shade: packets of consecutive triangles of one draw in a tile, in submission order. A batch can contain packets of
// several triangles, so the shader runs on full batches even if triangles are small.
#pragma once

#include <span>

#include "halfspace/raster/visibility/sink/packet_batch.h"

namespace halfspace::HS_LANES {

/// The VisibilityMode of the draw determines whether the packets have passed the depth test. In a multisampled tile, packets are numbered
/// as in the sample plane of sample 0, and each has the lanes and depths of all samples.
struct PacketQueue {
  /// If the queue contains at least this many packets, it must be shaded before a triangle is added. The arrays have room for the packets
  /// of one more triangle and for one element after the last one. Summed over its samples, a multisampled triangle has at most kPackets
  /// packets.
  static constexpr int kShadeAt = 64;
  static constexpr std::size_t kCapacity = kShadeAt + kPackets + 1;
  static constexpr std::size_t kDepthCapacity = kShadeAt * kMaxSamples + kPackets + 1;

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
  /// Returns sample s of packet i as a packet of the tile's storage. The tile must be multisampled.
  PacketMask sample(const Tile& tile, std::size_t i, int s) const {
    const int shift = packet_shift(sample_plane(tile.samples, s, tile.size));
    return {static_cast<uint16_t>(packets[i].packet + shift), sample_lanes[i][static_cast<std::size_t>(s)]};
  }
  /// Returns the depth of sample s of packet i.
  Real& sample_depth(const Tile& tile, std::size_t i, int s) {
    return depth[i * static_cast<std::size_t>(tile.samples) + static_cast<std::size_t>(s)];
  }

  int count = 0;
  std::array<PacketMask, kCapacity> packets;  ///< in a multisampled tile, the lanes in which any sample is covered
  std::array<TriangleId, kCapacity> ids;
  /// Lanes of each sample; only valid in a multisampled tile.
  std::array<SampleLanes, kCapacity> sample_lanes;
  /// Depth of the triangle, represented as in Tile::depth; see sample_depth(). Not valid for VisibilityMode::early, nor
  /// for cover_only without a depth bound.
  alignas(64) std::array<Real, kDepthCapacity> depth;
};

/// The packets of a queue that cover one sample, for draws that shade each sample. Packets have their numbers in the plane of the sample.
class QueuedSample {
 public:
  /// The arguments must outlive this object. The tile must be multisampled.
  QueuedSample(const PassContext& context, const Tile& tile, const PacketQueue& queue, int sample)
      : context_(context),
        tile_(tile),
        plane_(sample_plane(tile.samples, sample, tile.size)),
        position_(sample_position(tile.samples, sample)),
        sample_(sample) {
    for (int k = 0; k < queue.count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const PacketMask packet = queue.sample(tile, i, sample);
      packets_[count_] = packet;
      ids_[count_] = queue.ids[i];
      index_[count_] = static_cast<uint16_t>(k);
      count_ += packet.lanes != 0 ? 1 : 0;
    }
  }

  std::size_t count() const { return count_; }
  /// Returns the number of packet i in the queue.
  std::size_t index(std::size_t i) const { return index_[i]; }
  std::span<const PacketMask> packets() const { return {packets_.data(), count_}; }
  const TriangleId* ids() const { return ids_.data(); }
  /// Returns n packets for a kernel that evaluates the shader at the sample, starting with packet `begin`.
  PacketBatch batch(std::size_t begin, std::size_t n) const {
    return {.context = &context_,
            .tile_x0 = tile_.x0 - plane_.x,
            .tile_y0 = tile_.y0 - plane_.y,
            .position = position_,
            .sample = sample_,
            .packet_ids = &ids_[begin],
            .packets = &packets_[begin],
            .count = static_cast<int>(n)};
  }

 private:
  const PassContext& context_;
  const Tile& tile_;
  SamplePlane plane_;
  SamplePosition position_;
  int sample_;
  std::size_t count_ = 0;
  std::array<PacketMask, PacketQueue::kCapacity> packets_;
  std::array<TriangleId, PacketQueue::kCapacity> ids_;
  std::array<uint16_t, PacketQueue::kCapacity> index_;
};

}  // namespace halfspace::HS_LANES
