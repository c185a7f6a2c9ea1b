// SPDX-License-Identifier: Apache-2.0
//
// Edge functions of a primitive at the samples of one tile, prepared for stepping from pixel to pixel.
#pragma once

#include <algorithm>
#include <array>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// One sample of every pixel of a tile. Pixels are numbered by their position in the tile's storage, so the number of a pixel also selects
/// the packet that stores the sample (raster/pipeline/sample_pattern.h).
struct SampleGrid {
  SampleGrid(const Tile& tile, int s)
      : plane(s == 0 ? SamplePlane{0, 0} : sample_plane(tile.samples, s, tile.size)),
        x0(tile.x0 - plane.x),
        y0(tile.y0 - plane.y),
        position(sample_position(tile.samples, s)) {}

  SamplePlane plane;
  int x0, y0;  ///< window coordinates of pixel (0, 0)
  SamplePosition position;

  int x_sub() const { return x0 * kSubPixels + position.x; }
  int y_sub() const { return y0 * kSubPixels + position.y; }
};

/// Edge functions of a triangle at the first sample of the grid, and their steps from pixel to pixel. For small triangles, they are in
/// (1/256 px)². For other triangles, they are shifted right by kSubPixelBits, which preserves the sign, and all steps are integers. The
/// bias of the fill rule is subtracted. If the whole tile is inside an edge of a larger triangle, all values of that edge are 0.
struct TileEdges {
  std::array<int32_t, 3> e, step_x, step_y;
  std::array<int32_t, 3> bias;
  bool outside = false;  ///< no sample of the tile is inside
};

/// Computes edge i of r, with `offset` added to its function. shift is 0 for small triangles, otherwise kSubPixelBits.
HS_INLINE void put_edge(const Edge& edge, int64_t offset, int32_t bias, int shift, const SampleGrid& grid, int tile_size, std::size_t i,
                        TileEdges& r) {
  const int64_t last = tile_size - 1;
  const int64_t step_x = -(int64_t{edge.ey} * kSubPixels) >> shift;
  const int64_t step_y = (int64_t{edge.ex} * kSubPixels) >> shift;
  r.bias[i] = bias;
  const int64_t e = (edge.at(grid.x_sub(), grid.y_sub()) + offset - bias) >> shift;
  int64_t corner = e;
  if ((grid.plane.x | grid.plane.y) != 0) corner += step_x * grid.plane.x + step_y * grid.plane.y;
  const int64_t low = corner + std::min<int64_t>(0, step_x * last) + std::min<int64_t>(0, step_y * last);
  const int64_t high = corner + std::max<int64_t>(0, step_x * last) + std::max<int64_t>(0, step_y * last);
  if (high < 0) r.outside = true;
  const bool drop = low >= 0 && shift != 0;
  r.e[i] = drop || high < 0 ? 0 : static_cast<int32_t>(e);
  r.step_x[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_x);
  r.step_y[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_y);
}

/// Computes the edges of a line. A point has no edges, because its bounds are exact.
__attribute__((noinline)) inline TileEdges point_or_line_edges(const Draw& draw, const Triangle& t, const SampleGrid& grid, int tile_size) {
  TileEdges r{};
  if (t.is(kPointSprite)) return r;
  const std::array<BandEdge, 2> band = band_edges(t, line_pixels(draw.state.line_width));
  for (std::size_t i = 0; i < 2; ++i) put_edge(band[i].edge, band[i].offset, band[i].bias, kSubPixelBits, grid, tile_size, i, r);
  return r;
}

inline TileEdges tile_edges(const Draw& draw, const Triangle& t, const SampleGrid& grid, int tile_size) {
  if (t.is(kPointSprite | kLine)) return point_or_line_edges(draw, t, grid, tile_size);
  TileEdges r;
  const int shift = t.is(kSmall) ? 0 : kSubPixelBits;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge edge = edge_of(t, i);
    put_edge(edge, 0, fill_bias(edge), shift, grid, tile_size, i, r);
  }
  return r;
}

}  // namespace halfspace::HS_LANES
