// SPDX-License-Identifier: Apache-2.0
//
// A primitive's edge functions and depth at the samples of one tile, ready to be stepped from pixel to pixel.
#pragma once

#include <algorithm>
#include <array>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// One sample of every pixel of a tile. Pixels count from the corner of the tile's room, so that those of a cell
/// (raster/pipeline/sample_pattern.h) are the packets that hold it.
struct SampleGrid {
  SampleGrid(const Tile& tile, int s)
      : cell(s == 0 ? SampleCell{0, 0} : sample_cell(tile.samples, s, tile.size)),
        x0(tile.x0 - cell.x),
        y0(tile.y0 - cell.y),
        position(sample_position(tile.samples, s)) {}

  SampleCell cell;
  int x0, y0;  ///< window coordinates of pixel (0, 0)
  SamplePosition position;

  int x_sub() const { return x0 * kSubPixels + position.x; }
  int y_sub() const { return y0 * kSubPixels + position.y; }
};

/// A triangle's edge functions at the grid's first sample and their steps from pixel to pixel. For a small triangle in
/// full (1/256 px)²; for others shifted down by kSubPixelBits, which keeps their sign and makes the steps whole numbers.
/// The fill rule's bias is taken off. An edge that the whole tile is inside of is zero throughout.
struct TileEdges {
  std::array<int32_t, 3> e, step_x, step_y;
  std::array<int32_t, 3> bias;
  bool outside = false;  ///< no sample of the tile is inside
};

/// Edge i of r, with `offset` added to its function; shift: kSubPixelBits or, where all is small, 0.
HS_INLINE void put_edge(const Edge& edge, int64_t offset, int32_t bias, int shift, const SampleGrid& grid, int tile_size, std::size_t i,
                        TileEdges& r) {
  const int64_t last = tile_size - 1;
  const int64_t step_x = -(int64_t{edge.ey} * kSubPixels) >> shift;
  const int64_t step_y = (int64_t{edge.ex} * kSubPixels) >> shift;
  r.bias[i] = bias;
  const int64_t e = (edge.at(grid.x_sub(), grid.y_sub()) + offset - bias) >> shift;
  int64_t corner = e;
  if ((grid.cell.x | grid.cell.y) != 0) corner += step_x * grid.cell.x + step_y * grid.cell.y;
  const int64_t low = corner + std::min<int64_t>(0, step_x * last) + std::min<int64_t>(0, step_y * last);
  const int64_t high = corner + std::max<int64_t>(0, step_x * last) + std::max<int64_t>(0, step_y * last);
  if (high < 0) r.outside = true;
  const bool drop = low >= 0 && shift != 0;
  r.e[i] = drop || high < 0 ? 0 : static_cast<int32_t>(e);
  r.step_x[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_x);
  r.step_y[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_y);
}

/// Of a point, whose bounds say all, or of a line.
__attribute__((noinline)) inline TileEdges rare_edges(const Draw& draw, const Triangle& t, const SampleGrid& grid, int tile_size) {
  TileEdges r{};
  if (t.is(kSprite)) return r;
  const std::array<BandEdge, 2> band = band_edges(t, line_pixels(draw.state.line_width));
  for (std::size_t i = 0; i < 2; ++i) put_edge(band[i].edge, band[i].offset, band[i].bias, kSubPixelBits, grid, tile_size, i, r);
  return r;
}

inline TileEdges tile_edges(const Draw& draw, const Triangle& t, const SampleGrid& grid, int tile_size) {
  if (t.is(kSprite | kLine)) return rare_edges(draw, t, grid, tile_size);
  TileEdges r;
  const int shift = t.is(kSmall) ? 0 : kSubPixelBits;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge edge = edge_of(t, i);
    put_edge(edge, 0, fill_bias(edge), shift, grid, tile_size, i, r);
  }
  return r;
}

/// Bounds of a triangle's depths, as Tile::depth holds them.
struct DepthBounds {
  float low, high;
};
inline DepthBounds depth_bounds(const Triangle& t, const Draw& draw, DepthFormat format) {
  const float high = std::clamp(t.z_max, draw.depth_low, draw.depth_high);
  return {depth_value(format, std::clamp(t.z0, draw.depth_low, high)), depth_value(format, high)};
}

/// The depth of a triangle at the samples of packets.
template <bool small>
class DepthPlane {
 public:
  DepthPlane(const Triangle& t, const TileEdges& edges, const Draw& draw, const SampleGrid& grid, DepthFormat format)
      : z0_(t.z0),
        z_edge1_(t.z_edge1),
        z_edge2_(t.z_edge2),
        low_(t.is(kLine) ? std::clamp(t.z0, draw.depth_low, draw.depth_high) : draw.depth_low),
        high_(std::clamp(t.z_max, draw.depth_low, draw.depth_high)),
        format_(format) {
    if constexpr (small) {
      bias1_ = edges.bias[1];
      bias2_ = edges.bias[2];
    } else {
      e1x_ = static_cast<float>(t.x[1] - t.x[0]);
      e1y_ = static_cast<float>(t.y[1] - t.y[0]);
      e2x_ = static_cast<float>(t.x[2] - t.x[0]);
      e2y_ = static_cast<float>(t.y[2] - t.y[0]);
      dx_ = grid.x_sub() - t.x[0];
      dy_ = grid.y_sub() - t.y[0];
    }
  }

  // x, y: the packet's place in the tile's room; edges: its BlockEdges.
  template <class E>
  HS_INLINE Real at(const E& edges, int x, int y) const {
    Real w1, w2;
    if constexpr (small) {
      w1 = to_real<Real>(edges.values(1, x, y) + bias1_);
      w2 = to_real<Real>(edges.values(2, x, y) + bias2_);
    } else {
      const Real dx = to_real<Real>(lane_x() * kSubPixels + (dx_ + x * kSubPixels));
      const Real dy = to_real<Real>(lane_y() * kSubPixels + (dy_ + y * kSubPixels));
      w1 = difference_of_products(dx, Real(e2y_), dy, Real(e2x_));
      w2 = difference_of_products(Real(e1x_), dy, Real(e1y_), dx);
    }
    const Real z = fma(w1, Real(z_edge1_), fma(w2, Real(z_edge2_), Real(z0_)));
    return depth_value(format_, clamp(z, Real(low_), Real(high_)));
  }

 private:
  float z0_, z_edge1_, z_edge2_, low_, high_;
  DepthFormat format_;
  int32_t bias1_ = 0, bias2_ = 0;
  float e1x_ = 0, e1y_ = 0, e2x_ = 0, e2y_ = 0;
  int32_t dx_ = 0, dy_ = 0;
};

}  // namespace halfspace
