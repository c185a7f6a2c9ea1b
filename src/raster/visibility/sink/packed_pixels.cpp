// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/sink/packed_pixels.h"

#include <bit>

#include "halfspace/core/lane_packing.h"
#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

namespace {

// Returns how many packets at the start of the list have pixels that fit. Sets `pixels` to the number of these pixels.
std::size_t packets_that_fit(std::span<const PacketMask> packets, std::size_t& pixels) {
  pixels = 0;
  std::size_t n = 0;
  for (; n < packets.size(); ++n) {
    const std::size_t sum = pixels + static_cast<std::size_t>(std::popcount(packets[n].lanes));
    if (sum > PackedPixels::kCapacity) break;
    pixels = sum;
  }
  return n;
}

}  // namespace

bool can_pack(const Draw& draw, const Tile& tile) {
  return !draw.kernels.is_constant && (tile.samples == 1 || (!draw.kernels.uses_centroid && !draw.covers_by_shader));
}

bool pays_to_pack(std::span<const PacketMask> packets) { return pixel_count(packets) * 4 <= packets.size() * kLanes * 3; }

bool packs_queue(const Draw& draw, const Tile& tile, std::span<const PacketMask> packets) {
  return can_pack(draw, tile) && !draws_points(draw.state) && pays_to_pack(packets);
}

PacketBatch PackedPixels::batch(const PassContext& context, const Tile& tile) const {
  return {.context = &context,
          .tile_x0 = tile.x0,
          .tile_y0 = tile.y0,
          .ids = ids.data(),
          .packets = packets.data(),
          .count = packet_count(),
          .pixels = pixels.data()};
}

namespace {

// Implements pack(). tile_size: packets are in a sample plane of a tile of this size. ids_of(n): triangles of packet n, one per lane.
template <class F>
HS_INLINE std::size_t pack_packets(std::span<const PacketMask> packets, int tile_size, PackedPixels& out, const F& ids_of) {
  const std::size_t taken = packets_that_fit(packets, out.count);
  std::size_t to = 0;
  for (std::size_t n = 0; n < taken; ++n) {
    const auto [packet, lanes] = packets[n];
    const int x = packet_x(packet) & (tile_size - 1), y = packet_y(packet) & (tile_size - 1);
    store(&out.pixels[to], pack_lanes(((lane_y() + y) << 16) | (lane_x() + x), lanes));
    store(&out.ids[to], ids_of(n));
    to += static_cast<std::size_t>(std::popcount(lanes));
  }
  // The lanes after the last pixel compute with the first pixel and its triangle.
  store(&out.pixels[to], Int(out.pixels[0]));
  store(&out.ids[to], Int(std::bit_cast<int32_t>(out.ids[0])));
  for (std::size_t i = 0; i * kLanes < to; ++i) {
    const std::size_t rest = to - i * kLanes;
    out.packets[i] = {static_cast<uint16_t>(i), static_cast<uint16_t>(rest >= kLanes ? kAllBits<Mask> : (1u << rest) - 1)};
  }
  return taken;
}

}  // namespace

std::size_t pack(std::span<const PacketMask> packets, const TriangleId* ids, PackedPixels& out) {
  return pack_packets(packets, kMaxTileSize, out, [&](std::size_t n) { return Int(std::bit_cast<int32_t>(ids[n])); });
}

std::size_t pack_visible(std::span<const PacketMask> packets, const TriangleId* ids, int tile_size, PackedPixels& out) {
  return pack_packets(packets, tile_size, out, [&](std::size_t n) {
    return pack_lanes(load<Int>(ids + static_cast<std::size_t>(packets[n].packet) * kLanes), packets[n].lanes);
  });
}

uint16_t unpack_keep(const uint16_t* packed, std::size_t first, uint32_t lanes) {
  const uint32_t bits = packed[first / kLanes] | uint32_t{packed[first / kLanes + 1]} << kLanes;
  return static_cast<uint16_t>(unpack_bits(bits >> first % kLanes, lanes));
}

}  // namespace halfspace::HS_LANES
