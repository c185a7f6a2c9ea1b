// SPDX-License-Identifier: Apache-2.0
//
// A primitive's edge functions as the blocks and packets of a tile ask for them, and what a block's depth bounds say.
#pragma once

#include <algorithm>
#include <array>

#include "halfspace/raster/visibility/tile_edges.h"

namespace halfspace {

namespace detail {
inline constexpr int kPacketColumns = kMaxTileSize / kPacketWidth, kPacketRows = kMaxTileSize / kPacketHeight;
constexpr std::array<std::array<uint16_t, kPacketColumns>, kPacketRows> make_packet_places() {
  std::array<std::array<uint16_t, kPacketColumns>, kPacketRows> at{};
  for (int p = 0; p < kPackets; ++p) {
    at[static_cast<std::size_t>(packet_y(p) / kPacketHeight)][static_cast<std::size_t>(packet_x(p) / kPacketWidth)] =
        static_cast<uint16_t>(p);
  }
  return at;
}
inline constexpr auto kPacketPlaces = make_packet_places();
}  // namespace detail

/// The packet that holds pixel (x, y) of the tile's room.
HS_INLINE int packet_at(int x, int y) {
  return detail::kPacketPlaces[static_cast<std::size_t>(y / kPacketHeight)][static_cast<std::size_t>(x / kPacketWidth)];
}

enum class BlockCoverage : uint8_t { none, some, whole };

struct BlockEdges {
  explicit BlockEdges(const TileEdges& edges) : at(edges) {
    constexpr int32_t last = kBlockSize - 1;
    for (std::size_t i = 0; i < 3; ++i) {
      lanes[i] = lane_x() * at.step_x[i] + lane_y() * at.step_y[i];
      rise[i] = std::max(0, at.step_x[i] * last) + std::max(0, at.step_y[i] * last);
      fall[i] = std::min(0, at.step_x[i] * last) + std::min(0, at.step_y[i] * last);
    }
  }
  /// Edge i at pixel (x, y) of the tile's room; and at a packet's pixels.
  int32_t value(std::size_t i, int x, int y) const { return at.e[i] + at.step_x[i] * x + at.step_y[i] * y; }
  HS_INLINE Int values(std::size_t i, int packet_x, int packet_y) const { return lanes[i] + value(i, packet_x, packet_y); }
  HS_INLINE Mask inside(int packet_x, int packet_y) const {
    return (values(0, packet_x, packet_y) | values(1, packet_x, packet_y) | values(2, packet_x, packet_y)) >= Int(0);
  }

  const TileEdges& at;
  std::array<Int, 3> lanes;           ///< what is added from a packet's corner to its pixels
  std::array<int32_t, 3> rise, fall;  ///< from a block's corner to the largest and the least value in it
};

inline BlockCoverage block_coverage(const BlockEdges& edges, int x, int y) {
  bool whole = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const int32_t e = edges.value(i, x, y);
    if (e + edges.rise[i] < 0) return BlockCoverage::none;
    whole &= e + edges.fall[i] >= 0;
  }
  return whole ? BlockCoverage::whole : BlockCoverage::some;
}

/// Pixels of the tile's room, half open.
struct TileRect {
  int x0, y0, x1, y1;
};
HS_INLINE Mask inside(const TileRect& r, int packet_x, int packet_y) {
  const Int x = lane_x() + packet_x, y = lane_y() + packet_y;
  return (x >= Int(r.x0)) & (x < Int(r.x1)) & (y >= Int(r.y0)) & (y < Int(r.y1));
}

/// Writes after which a block's bounds are made exact again before they are asked: a refresh costs about one packet.
inline constexpr uint8_t kRefreshAfter = 8;

enum class BlockTest : uint8_t { none_passes, some_may, all_pass };

/// What bounds of stored depths say of values in [low, high].
inline BlockTest test_bounds(CompareOp op, float low, float high, float block_min, float block_max) {
  const auto say = [](bool none, bool all) { return none ? BlockTest::none_passes : all ? BlockTest::all_pass : BlockTest::some_may; };
  switch (op) {
    case CompareOp::never: return BlockTest::none_passes;
    case CompareOp::less: return say(low >= block_max, high < block_min);
    case CompareOp::less_equal: return say(low > block_max, high <= block_min);
    case CompareOp::greater: return say(high <= block_min, low > block_max);
    case CompareOp::greater_equal: return say(high < block_min, low >= block_max);
    case CompareOp::equal: return say(high < block_min || low > block_max, false);
    case CompareOp::not_equal: return say(false, high < block_min || low > block_max);
    case CompareOp::always: return BlockTest::all_pass;
  }
  return BlockTest::some_may;
}

/// Remembers that values in [low, high] that passed the test were written to a block.
HS_INLINE void widen_block_bounds(CompareOp op, Tile& tile, int block, float low, float high) {
  // What passes LESS only lowers the values, what passes GREATER only raises them.
  const bool lowers = op == CompareOp::less || op == CompareOp::less_equal;
  const bool raises = op == CompareOp::greater || op == CompareOp::greater_equal;
  const auto b = static_cast<std::size_t>(block);
  if (!raises) tile.block_min[b] = std::min(tile.block_min[b], low);
  if (!lowers) tile.block_max[b] = std::max(tile.block_max[b], high);
  if (tile.block_writes[b] < kRefreshAfter) ++tile.block_writes[b];
}

inline BlockTest test_block(CompareOp op, Tile& tile, int block, float low, float high) {
  const auto b = static_cast<std::size_t>(block);
  if (tile.block_writes[b] >= kRefreshAfter) refresh_block_bounds(tile, block);
  return test_bounds(op, low, high, tile.block_min[b], tile.block_max[b]);
}

/// The same of all blocks together.
inline BlockTest test_tile(CompareOp op, const Tile& tile, float low, float high) {
  Real least = load<Real>(tile.block_min.data()), largest = load<Real>(tile.block_max.data());
  for (int b = kLanes; b < kBlocks; b += kLanes) {
    least = min(least, load<Real>(&tile.block_min[static_cast<std::size_t>(b)]));
    largest = max(largest, load<Real>(&tile.block_max[static_cast<std::size_t>(b)]));
  }
  float tile_min = lane(least, 0), tile_max = lane(largest, 0);
  for (int i = 1; i < kLanes; ++i) {
    tile_min = std::min(tile_min, lane(least, i));
    tile_max = std::max(tile_max, lane(largest, i));
  }
  return test_bounds(op, low, high, tile_min, tile_max);
}

}  // namespace halfspace
