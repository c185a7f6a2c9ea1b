// SPDX-License-Identifier: Apache-2.0
//
// Hierarchical depth: what the bounds of the depths stored in a block or a tile say of a triangle's depths.
#pragma once

#include <algorithm>

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// Writes after which a block's bounds are made exact again before they are asked: a refresh costs about one packet.
inline constexpr uint8_t kRefreshAfter = 8;

enum class BlockTest : uint8_t { none_passes, some_may, all_pass };

/// What bounds of stored depths say of values in [low, high].
inline BlockTest test_bounds(CompareOp op, float low, float high, float hiz_min, float hiz_max) {
  const auto say = [](bool none, bool all) { return none ? BlockTest::none_passes : all ? BlockTest::all_pass : BlockTest::some_may; };
  switch (op) {
    case CompareOp::never: return BlockTest::none_passes;
    case CompareOp::less: return say(low >= hiz_max, high < hiz_min);
    case CompareOp::less_equal: return say(low > hiz_max, high <= hiz_min);
    case CompareOp::greater: return say(high <= hiz_min, low > hiz_max);
    case CompareOp::greater_equal: return say(high < hiz_min, low >= hiz_max);
    case CompareOp::equal: return say(high < hiz_min || low > hiz_max, false);
    case CompareOp::not_equal: return say(false, high < hiz_min || low > hiz_max);
    case CompareOp::always: return BlockTest::all_pass;
  }
  return BlockTest::some_may;
}

/// Remembers that values in [low, high] that passed the test were written to a block.
HS_INLINE void widen_hiz(CompareOp op, Tile& tile, int block, float low, float high) {
  // What passes LESS only lowers the values, what passes GREATER only raises them.
  const bool lowers = op == CompareOp::less || op == CompareOp::less_equal;
  const bool raises = op == CompareOp::greater || op == CompareOp::greater_equal;
  const auto b = static_cast<std::size_t>(block);
  if (!raises) tile.hiz_min[b] = std::min(tile.hiz_min[b], low);
  if (!lowers) tile.hiz_max[b] = std::max(tile.hiz_max[b], high);
  if (tile.hiz_writes[b] < kRefreshAfter) ++tile.hiz_writes[b];
}

inline BlockTest test_block(CompareOp op, Tile& tile, int block, float low, float high) {
  const auto b = static_cast<std::size_t>(block);
  if (tile.hiz_writes[b] >= kRefreshAfter) refresh_hiz(tile, block);
  return test_bounds(op, low, high, tile.hiz_min[b], tile.hiz_max[b]);
}

/// The same of all blocks together.
inline BlockTest test_tile(CompareOp op, const Tile& tile, float low, float high) {
  Real low_lanes = load<Real>(tile.hiz_min.data()), high_lanes = load<Real>(tile.hiz_max.data());
  for (int b = kLanes; b < kBlocks; b += kLanes) {
    low_lanes = min(low_lanes, load<Real>(&tile.hiz_min[static_cast<std::size_t>(b)]));
    high_lanes = max(high_lanes, load<Real>(&tile.hiz_max[static_cast<std::size_t>(b)]));
  }
  float tile_min = lane(low_lanes, 0), tile_max = lane(high_lanes, 0);
  for (int i = 1; i < kLanes; ++i) {
    tile_min = std::min(tile_min, lane(low_lanes, i));
    tile_max = std::max(tile_max, lane(high_lanes, i));
  }
  return test_bounds(op, low, high, tile_min, tile_max);
}

}  // namespace halfspace
