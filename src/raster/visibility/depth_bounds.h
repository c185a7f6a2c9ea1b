// SPDX-License-Identifier: Apache-2.0
//
// Hierarchical Z: compares the depth range of a triangle with the bounds of the depth stored in a block or tile.
#pragma once

#include <algorithm>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Number of writes after which the bounds of a block are recomputed before the next test. This costs about as much as one packet.
inline constexpr uint8_t kRefreshAfter = 8;

enum class BlockTest : uint8_t { none_passes, some_may, all_pass };

/// Compares depths in [low, high] with the bounds of stored depths.
inline BlockTest test_bounds(CompareOp op, float low, float high, float hiz_min, float hiz_max) {
  const auto outcome = [](bool none, bool all) { return none ? BlockTest::none_passes : all ? BlockTest::all_pass : BlockTest::some_may; };
  switch (op) {
    case CompareOp::never: return BlockTest::none_passes;
    case CompareOp::less: return outcome(low >= hiz_max, high < hiz_min);
    case CompareOp::less_equal: return outcome(low > hiz_max, high <= hiz_min);
    case CompareOp::greater: return outcome(high <= hiz_min, low > hiz_max);
    case CompareOp::greater_equal: return outcome(high < hiz_min, low >= hiz_max);
    case CompareOp::equal: return outcome(high < hiz_min || low > hiz_max, false);
    case CompareOp::not_equal: return outcome(false, high < hiz_min || low > hiz_max);
    case CompareOp::always: return BlockTest::all_pass;
  }
  return BlockTest::some_may;
}

/// Updates the bounds of a block after depths in [low, high] passed the test and were written.
HS_INLINE void widen_hiz(CompareOp op, Tile& tile, int block, float low, float high) {
  // LESS can only lower the stored depth, and GREATER can only raise it.
  const bool lowers = op == CompareOp::less || op == CompareOp::less_equal;
  const bool raises = op == CompareOp::greater || op == CompareOp::greater_equal;
  const auto b = static_cast<std::size_t>(block);
  if (!raises) tile.hiz_min[b] = std::min(tile.hiz_min[b], low);
  if (!lowers) tile.hiz_max[b] = std::max(tile.hiz_max[b], high);
  if (tile.hiz_writes[b] < kRefreshAfter) ++tile.hiz_writes[b];
}

/// Compares depths in [low, high] with the depth of a block. Recomputes its bounds if necessary.
inline BlockTest test_block(CompareOp op, Tile& tile, int block, float low, float high) {
  const auto b = static_cast<std::size_t>(block);
  if (tile.hiz_writes[b] >= kRefreshAfter) refresh_hiz(tile, block);
  return test_bounds(op, low, high, tile.hiz_min[b], tile.hiz_max[b]);
}

/// Compares depths in [low, high] with the depth of the whole tile.
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

}  // namespace halfspace::inline HS_LANES_NAMESPACE
