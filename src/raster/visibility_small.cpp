// SPDX-License-Identifier: Apache-2.0
//
// Visibility of small triangles in plain draws, which are most: no blocks, all in int32, a packet at a time.
#include <algorithm>
#include <bit>

#include "raster/compare.h"
#include "raster/edge.h"
#include "raster/visibility.h"

namespace halfspace {

namespace {

constexpr int kPacketColumns = kMaxTileSize / kPacketWidth, kPacketRows = kMaxTileSize / kPacketHeight;

constexpr std::array<std::array<uint16_t, kPacketColumns>, kPacketRows> make_packet_places() {
  std::array<std::array<uint16_t, kPacketColumns>, kPacketRows> at{};
  for (int p = 0; p < kPackets; ++p) {
    at[static_cast<std::size_t>(packet_y(p) / kPacketHeight)][static_cast<std::size_t>(packet_x(p) / kPacketWidth)] = static_cast<uint16_t>(p);
  }
  return at;
}
// The packet at a row and column of packets.
constexpr auto kPacketAt = make_packet_places();

// An edge function of a small triangle: its value at the tile's first sample, and its steps from pixel to pixel.
struct SmallEdge {
  int32_t e, step_x, step_y, bias;
};
SmallEdge small_edge(const std::array<int32_t, 3>& x, const std::array<int32_t, 3>& y, std::size_t i) {
  const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
  const Edge edge{x[a], y[a], x[b] - x[a], y[b] - y[a]};
  const int32_t bias = fill_bias(edge);
  return {edge.ey * edge.x0 - edge.ex * edge.y0 - bias, -edge.ey * kSubPixels, edge.ex * kSubPixels, bias};
}

// Which lanes pass the depth test; z is written where they do.
HS_INLINE Mask test_and_write(const DrawInTile& d, float* stored, Real z, Mask mask) {
  const Real old = load<Real>(stored);
  mask = mask & compare(d.draw.state.depth.compare, z, old);
  if (d.draw.state.depth.write) store(stored, select(mask, z, old));
  return mask;
}

}  // namespace

void rasterize_small(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics) {
  Tile& tile = d.tile;
  // Everything from the tile's first sample; the triangle meets the tile and is small, so all fits in 16 bits.
  const int32_t x_first = tile.x0 * kSubPixels + kSubPixels / 2, y_first = tile.y0 * kSubPixels + kSubPixels / 2;
  const std::array<int32_t, 3> x{t.x[0] - x_first, t.x[1] - x_first, t.x[2] - x_first};
  const std::array<int32_t, 3> y{t.y[0] - y_first, t.y[1] - y_first, t.y[2] - y_first};
  const int x0 = std::max(d.bounds.x0 - tile.x0, (std::min({x[0], x[1], x[2]}) + kSubPixels - 1) >> kSubPixelBits);
  const int y0 = std::max(d.bounds.y0 - tile.y0, (std::min({y[0], y[1], y[2]}) + kSubPixels - 1) >> kSubPixelBits);
  const int x1 = std::min(d.bounds.x1 - tile.x0, (std::max({x[0], x[1], x[2]}) >> kSubPixelBits) + 1);
  const int y1 = std::min(d.bounds.y1 - tile.y0, (std::max({y[0], y[1], y[2]}) >> kSubPixelBits) + 1);
  if (x0 >= x1 || y0 >= y1) return;

  const std::array<SmallEdge, 3> edge{small_edge(x, y, 0), small_edge(x, y, 1), small_edge(x, y, 2)};
  std::array<Int, 3> first;  // the edges in the tile's first packet
  for (std::size_t i = 0; i < 3; ++i) first[i] = lane_x() * edge[i].step_x + lane_y() * edge[i].step_y + edge[i].e;
  const float z_high = std::clamp(t.z_max, d.draw.depth_low, d.draw.depth_high);
  const float low = depth_value(tile.depth_format, std::clamp(t.z0, d.draw.depth_low, z_high)), high = depth_value(tile.depth_format, z_high);

  for (int row = y0 / kPacketHeight; row <= (y1 - 1) / kPacketHeight; ++row) {
    for (int column = x0 / kPacketWidth; column <= (x1 - 1) / kPacketWidth; ++column) {
      std::array<Int, 3> e;
      for (std::size_t i = 0; i < 3; ++i) {
        e[i] = first[i] + (edge[i].step_x * (column * kPacketWidth) + edge[i].step_y * (row * kPacketHeight));
      }
      Mask mask = (e[0] | e[1] | e[2]) >= Int(0);
      if (d.cut) {
        const Int px = lane_x() + column * kPacketWidth, py = lane_y() + row * kPacketHeight;
        mask = mask & (px >= Int(x0)) & (px < Int(x1)) & (py >= Int(y0)) & (py < Int(y1));
      }
      const uint32_t covered = bits(mask);
      if (covered == 0) continue;
      statistics.samples_tested += static_cast<uint64_t>(std::popcount(covered));
      const int packet = kPacketAt[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      const std::size_t pixels = static_cast<std::size_t>(packet) * kLanes;
      if (d.tests) {
        const Real w1 = to_real<Real>(e[1] + edge[1].bias), w2 = to_real<Real>(e[2] + edge[2].bias);
        const Real z = clamp(fma(w1, Real(t.z_edge1), fma(w2, Real(t.z_edge2), Real(t.z0))), Real(d.draw.depth_low), Real(z_high));
        mask = test_and_write(d, &tile.depth[pixels], depth_value(tile.depth_format, z), mask);
        if (none(mask)) continue;
        if (d.draw.state.depth.write) widen_block_bounds(d.draw.state.depth.compare, tile, packet / kPacketsPerBlock, low, high);
      }
      statistics.samples_passed += static_cast<uint64_t>(std::popcount(bits(mask)));
      if (d.mode == VisibilityMode::deferred) {
        store(&tile.id[pixels], select(mask, Int(std::bit_cast<int32_t>(id)), load<Int>(&tile.id[pixels])));
      }
    }
  }
}

}  // namespace halfspace
