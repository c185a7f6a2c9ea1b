// SPDX-License-Identifier: Apache-2.0
//
// Edge functions of a primitive in the blocks and packets of a tile.
#pragma once

#include <algorithm>
#include <array>

#include "halfspace/raster/visibility/tile_edges.h"

namespace halfspace::HS_LANES {

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

/// Returns the packet that contains pixel (x, y) of the tile's storage.
HS_INLINE int packet_at(int x, int y) {
  return detail::kPacketPlaces[static_cast<std::size_t>(y / kPacketHeight)][static_cast<std::size_t>(x / kPacketWidth)];
}

enum class BlockCoverage : uint8_t { none, some, whole };

/// Edge functions of a primitive, evaluated for pixels, packets and blocks of the tile's storage.
struct BlockEdges {
  explicit BlockEdges(const TileEdges& edges) : at(edges) {
    constexpr int32_t last = kBlockSize - 1;
    for (std::size_t i = 0; i < 3; ++i) {
      lanes[i] = lane_x() * at.step_x[i] + lane_y() * at.step_y[i];
      rise[i] = std::max(0, at.step_x[i] * last) + std::max(0, at.step_y[i] * last);
      fall[i] = std::min(0, at.step_x[i] * last) + std::min(0, at.step_y[i] * last);
    }
  }
  /// value() returns edge i at pixel (x, y); values() returns it for all pixels of a packet. value_step() returns how much it changes over
  /// x and y pixels.
  int32_t value_step(std::size_t i, int x, int y) const { return at.step_x[i] * x + at.step_y[i] * y; }
  int32_t value(std::size_t i, int x, int y) const { return at.e[i] + value_step(i, x, y); }
  HS_INLINE Int values(std::size_t i, int packet_x, int packet_y) const { return lanes[i] + value(i, packet_x, packet_y); }
  HS_INLINE Mask inside(int packet_x, int packet_y) const {
    return (values(0, packet_x, packet_y) | values(1, packet_x, packet_y) | values(2, packet_x, packet_y)) >= Int(0);
  }

  const TileEdges& at;
  std::array<Int, 3> lanes;           ///< offsets from the corner of a packet to its pixels
  std::array<int32_t, 3> rise, fall;  ///< offsets from the corner of a block to the largest and smallest value in it
};

/// Returns how much of the block with corner (x, y) is inside all edges.
inline BlockCoverage block_coverage(const BlockEdges& edges, int x, int y) {
  bool whole = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const int32_t e = edges.value(i, x, y);
    if (e + edges.rise[i] < 0) return BlockCoverage::none;
    whole &= e + edges.fall[i] >= 0;
  }
  return whole ? BlockCoverage::whole : BlockCoverage::some;
}

/// Half-open rectangle of pixels in the tile's storage.
struct TileRect {
  int x0, y0, x1, y1;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  /// Returns true if it contains the block with corner (x, y).
  bool contains_block(int x, int y) const { return x >= x0 && y >= y0 && x + kBlockSize <= x1 && y + kBlockSize <= y1; }
};
/// Returns bounds in window coordinates as a rectangle. x0, y0: window coordinates of pixel (0, 0) of the tile's storage.
inline TileRect tile_rect(const PixelBounds& b, int x0, int y0) { return {b.x0 - x0, b.y0 - y0, b.x1 - x0, b.y1 - y0}; }
HS_INLINE Mask inside(const TileRect& r, int packet_x, int packet_y) {
  const Int x = lane_x() + packet_x, y = lane_y() + packet_y;
  return (x >= Int(r.x0)) & (x < Int(r.x1)) & (y >= Int(r.y0)) & (y < Int(r.y1));
}

}  // namespace halfspace::HS_LANES
