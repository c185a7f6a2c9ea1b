// SPDX-License-Identifier: Apache-2.0
//
// Edge functions and depth of small triangles, in int32.
#pragma once

#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

/// Larger triangles are rasterized in blocks.
inline constexpr int kMaxSmallSpan = 48;  // px

template <class T>
using PerTriangle = std::array<T, static_cast<std::size_t>(kLanes)>;

/// Edge function of a triangle: its value at the first sample of the grid, and its steps from pixel to pixel.
struct SmallEdge {
  int32_t e, step_x, step_y;
};

/// Depth planes: z0 + e1·z_edge1 + e2·z_edge2, clamped to [low, high]. e1 and e2 are the values of edges 1 and 2 without bias. Lanes are
/// triangles, or pixels of one triangle.
struct SmallDepth {
  Real z0, z_edge1, z_edge2, low, high;

  HS_INLINE Real at(DepthFormat format, Int e1, Int e2) const {
    return depth_value(format, clamp(fma(to_real<Real>(e1), z_edge1, fma(to_real<Real>(e2), z_edge2, z0)), low, high));
  }
};

/// Returns the depth plane of a triangle, for its pixels.
inline SmallDepth small_depth(const Triangle& t, float depth_low, float depth_high) {
  const float high = std::clamp(t.z_max, depth_low, depth_high);
  return {Real(t.z0), Real(t.z_edge1), Real(t.z_edge2), Real(depth_low), Real(high)};
}

}  // namespace halfspace::HS_LANES
