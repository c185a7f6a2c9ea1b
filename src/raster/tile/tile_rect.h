// SPDX-License-Identifier: Apache-2.0
//
// Rectangles of pixels in a tile, and where its packets are stored.
#pragma once

#include <array>

#include "halfspace/raster/tile/tile.h"

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

/// Half-open rectangle of pixels in the tile's storage.
struct TileRect {
  int x0, y0, x1, y1;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  /// Returns true if it contains the block with corner (x, y).
  bool contains_block(int x, int y) const { return x >= x0 && y >= y0 && x + kBlockSize <= x1 && y + kBlockSize <= y1; }
};
/// Returns bounds in window coordinates as a rectangle in the plane of sample 0.
inline TileRect tile_rect(const PixelBounds& b, const Tile& tile) {
  return {b.x0 - tile.x0, b.y0 - tile.y0, b.x1 - tile.x0, b.y1 - tile.y0};
}
HS_INLINE Mask inside(const TileRect& r, int packet_x, int packet_y) {
  const Int x = lane_x() + packet_x, y = lane_y() + packet_y;
  return (x >= Int(r.x0)) & (x < Int(r.x1)) & (y >= Int(r.y0)) & (y < Int(r.y1));
}

}  // namespace halfspace::HS_LANES
