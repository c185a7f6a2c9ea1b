// SPDX-License-Identifier: Apache-2.0
//
// Hierarchical Z: compares the depth range of a triangle with the bounds of the depth stored in a block or tile.
#pragma once

#include <algorithm>

#include "halfspace/core/lane_reduce.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

/// Bounds of a triangle's depth, represented as in Tile::depth.
struct DepthBounds {
  float low, high;
};
inline DepthBounds depth_bounds(const Triangle& t, const Draw& draw, DepthFormat format) {
  const float high = std::clamp(t.z_max, draw.depth_low, draw.depth_high);
  return {depth_value(format, std::clamp(t.z0, draw.depth_low, high)), depth_value(format, high)};
}

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

/// Updates the bounds of a block after depths in [z.low, z.high] passed the test and were written.
HS_INLINE void widen_hiz(CompareOp op, Tile& tile, int block, DepthBounds z) {
  // LESS can only lower the stored depth, and GREATER can only raise it.
  const bool lowers = op == CompareOp::less || op == CompareOp::less_equal;
  const bool raises = op == CompareOp::greater || op == CompareOp::greater_equal;
  const auto b = static_cast<std::size_t>(block);
  if (!raises) tile.hiz_min[b] = std::min(tile.hiz_min[b], z.low);
  if (!lowers) tile.hiz_max[b] = std::max(tile.hiz_max[b], z.high);
  tile.hiz_is_stale[b] = true;
}

/// Sets the bounds of a block after all its depths were replaced with depths in [z.low, z.high].
inline void set_hiz(Tile& tile, int block, DepthBounds z) {
  const auto b = static_cast<std::size_t>(block);
  tile.hiz_min[b] = z.low;
  tile.hiz_max[b] = z.high;
  tile.hiz_is_stale[b] = false;
}

/// Compares depths in [z.low, z.high] with the depth of a block. Recomputes its bounds if they are stale and do not decide the test,
/// unless may_refresh is false.
inline BlockTest test_block(CompareOp op, Tile& tile, int block, DepthBounds z, bool may_refresh = true) {
  const auto b = static_cast<std::size_t>(block);
  const BlockTest test = test_bounds(op, z.low, z.high, tile.hiz_min[b], tile.hiz_max[b]);
  if (test != BlockTest::some_may || !tile.hiz_is_stale[b] || !may_refresh) return test;
  refresh_hiz(tile, block);
  return test_bounds(op, z.low, z.high, tile.hiz_min[b], tile.hiz_max[b]);
}

/// Compares depths in [z.low, z.high] with the depth of the whole tile.
inline BlockTest test_tile(CompareOp op, const Tile& tile, DepthBounds z) {
  Real low_lanes = load<Real>(tile.hiz_min.data()), high_lanes = load<Real>(tile.hiz_max.data());
  for (int b = kLanes; b < kBlocks; b += kLanes) {
    low_lanes = min(low_lanes, load<Real>(&tile.hiz_min[static_cast<std::size_t>(b)]));
    high_lanes = max(high_lanes, load<Real>(&tile.hiz_max[static_cast<std::size_t>(b)]));
  }
  return test_bounds(op, z.low, z.high, min_lane(low_lanes), max_lane(high_lanes));
}

}  // namespace halfspace::HS_LANES
