// SPDX-License-Identifier: Apache-2.0
//
// Depth of a triangle at the samples of a tile.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/visibility/tile_edges.h"

namespace halfspace::HS_LANES {

/// Bounds of a triangle's depth, represented as in Tile::depth.
struct DepthBounds {
  float low, high;
};
inline DepthBounds depth_bounds(const Triangle& t, const Draw& draw, DepthFormat format) {
  const float high = std::clamp(t.z_max, draw.depth_low, draw.depth_high);
  return {depth_value(format, std::clamp(t.z0, draw.depth_low, high)), depth_value(format, high)};
}

/// Bounds of a triangle's depth in rectangles of a tile. If the triangle is large and seen at an angle, these bounds are much tighter than
/// those of the whole triangle.
class DepthInTile {
 public:
  /// For one sample of every pixel.
  DepthInTile(const Triangle& t, const Draw& draw, const SampleGrid& grid, DepthFormat format)
      : DepthInTile(t, draw, grid.x_sub(), grid.y_sub(), 0, format) {}
  /// For all samples of every pixel. Pixels are numbered as in the plane of sample 0. samples_at: range of the sample positions.
  DepthInTile(const Triangle& t, const Draw& draw, const Tile& tile, const SampleSpan& samples_at)
      : DepthInTile(t, draw, tile.x0 * kSubPixels + (samples_at.low + samples_at.high) / 2,
                    tile.y0 * kSubPixels + (samples_at.low + samples_at.high) / 2, (samples_at.high - samples_at.low + 1) / 2,
                    tile.depth_format) {}

  /// Returns the bounds in a rectangle. x, y: its first pixel in the tile's storage.
  HS_INLINE DepthBounds at(int x, int y, int width, int height) const {
    if (!is_plane_) return {depth_value(format_, low_), depth_value(format_, high_)};
    const double half_x = 0.5 * (width - 1), half_y = 0.5 * (height - 1);
    const double center = z_ + step_x_ * (x + half_x) + step_y_ * (y + half_y);
    const double reach = std::abs(step_x_) * half_x + std::abs(step_y_) * half_y + margin_;
    const auto value = [&](double z) { return depth_value(format_, std::clamp(static_cast<float>(z), low_, high_)); };
    return {value(center - reach), value(center + reach)};
  }

 private:
  // x_sub, y_sub: center of the samples of pixel (0, 0), in 1/256 px. reach_sub: their largest distance from it along x and y.
  DepthInTile(const Triangle& t, const Draw& draw, int x_sub, int y_sub, int reach_sub, DepthFormat format)
      : format_(format),
        low_(std::clamp(t.z0, draw.depth_low, draw.depth_high)),
        high_(std::clamp(t.z_max, draw.depth_low, draw.depth_high)),
        is_plane_(!t.is(kLine | kPointSprite)) {
    if (!is_plane_) return;
    const double z0 = static_cast<double>(t.z0), z1 = static_cast<double>(t.z_edge1), z2 = static_cast<double>(t.z_edge2);
    const double e1x = t.x[1] - t.x[0], e1y = t.y[1] - t.y[0], e2x = t.x[2] - t.x[0], e2y = t.y[2] - t.y[0];
    const double x = x_sub - t.x[0], y = y_sub - t.y[0];
    const double by_x = e2y * z1 - e1y * z2, by_y = e1x * z2 - e2x * z1;
    z_ = z0 + by_x * x + by_y * y;
    step_x_ = by_x * kSubPixels;
    step_y_ = by_y * kSubPixels;
    // The first term is four times the rounding error of DepthPlane, whose terms are not negative in covered pixels. The second term
    // exceeds the rounding error of this class in any pixel of the tile.
    const double reach = kMaxTileSize * kSubPixels;
    const double terms = (std::abs(e2y) * z1 + std::abs(e1y) * z2) * (std::abs(x) + reach) +
                         (std::abs(e1x) * z2 + std::abs(e2x) * z1) * (std::abs(y) + reach);
    margin_ = 0x1p-20 * (2 * std::abs(z0) + std::abs(static_cast<double>(t.z_max))) + 0x1p-48 * terms;
    margin_ += (std::abs(by_x) + std::abs(by_y)) * reach_sub;
  }

  DepthFormat format_;
  float low_, high_;  // of the whole triangle
  bool is_plane_;
  double z_ = 0, step_x_ = 0, step_y_ = 0;  // depth at (x_sub, y_sub), and its steps from pixel to pixel
  double margin_ = 0;                       // largest rounding error, plus the change of depth within reach_sub
};

/// Computes the depth of a triangle at the samples of packets. `small` is true for triangles with kSmall.
template <bool small>
class DepthPlane {
 public:
  // bias: of the edges (fill rule).
  DepthPlane(const Triangle& t, const std::array<int32_t, 3>& bias, const Draw& draw, const SampleGrid& grid, DepthFormat format)
      : z0_(t.z0),
        z_edge1_(t.z_edge1),
        z_edge2_(t.z_edge2),
        low_(t.is(kLine) ? std::clamp(t.z0, draw.depth_low, draw.depth_high) : draw.depth_low),
        high_(std::clamp(t.z_max, draw.depth_low, draw.depth_high)),
        format_(format) {
    if constexpr (small) {
      bias1_ = bias[1];
      bias2_ = bias[2];
    } else {
      e1x_ = static_cast<float>(t.x[1] - t.x[0]);
      e1y_ = static_cast<float>(t.y[1] - t.y[0]);
      e2x_ = static_cast<float>(t.x[2] - t.x[0]);
      e2y_ = static_cast<float>(t.y[2] - t.y[0]);
      dx_ = grid.x_sub() - t.x[0];
      dy_ = grid.y_sub() - t.y[0];
    }
  }

  // x, y: position of the packet in the tile's storage; edges: BlockEdges of the triangle, or SampleEdges::at().
  // offset: position of the sample relative to that of the grid.
  template <class E>
  HS_INLINE Real at(const E& edges, int x, int y, SamplePosition offset = {}) const {
    if constexpr (small) {
      return from_edges(to_real<Real>(edges.values(1, x, y) + bias1_), to_real<Real>(edges.values(2, x, y) + bias2_));
    } else {
      return at_pixels(lane_x() + x, lane_y() + y, offset);
    }
  }

  // The same for any pixel of the tile's storage in each lane.
  HS_INLINE Real at_pixels(Int x, Int y, SamplePosition offset = {}) const {
    static_assert(!small);
    const Real dx = to_real<Real>(x * kSubPixels + (dx_ + offset.x)), dy = to_real<Real>(y * kSubPixels + (dy_ + offset.y));
    return from_edges(difference_of_products(dx, Real(e2y_), dy, Real(e2x_)), difference_of_products(Real(e1x_), dy, Real(e1y_), dx));
  }

 private:
  HS_INLINE Real from_edges(Real w1, Real w2) const {
    const Real z = fma(w1, Real(z_edge1_), fma(w2, Real(z_edge2_), Real(z0_)));
    return depth_value(format_, clamp(z, Real(low_), Real(high_)));
  }

  float z0_, z_edge1_, z_edge2_, low_, high_;
  DepthFormat format_;
  int32_t bias1_ = 0, bias2_ = 0;
  float e1x_ = 0, e1y_ = 0, e2x_ = 0, e2y_ = 0;
  int32_t dx_ = 0, dy_ = 0;
};

}  // namespace halfspace::HS_LANES
