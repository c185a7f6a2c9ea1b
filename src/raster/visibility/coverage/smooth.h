// SPDX-License-Identifier: Apache-2.0
//
// Visibility of smooth primitives (raster/pipeline/smooth_area.h). All pixels that a primitive overlaps are covered. The depth of a
// fragment is that of the pixel center, limited to the depths of the primitive.
#pragma once

#include <bit>

#include "halfspace/raster/pipeline/smooth_area.h"
#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"
#include "halfspace/raster/visibility/sink/writer.h"

namespace halfspace::HS_LANES {

/// Returns the areas of the pixels of a packet that a primitive covers. Lanes that are not in the packet are 0.
inline Real areas_in_packet(const SmoothArea& area, const Tile& tile, const PacketMask& packet) {
  Real areas(0.0f);
  const int x = tile.x0 + packet_x(packet.packet), y = tile.y0 + packet_y(packet.packet);
  for (uint32_t rest = packet.lanes; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    set_lane(areas, i, static_cast<float>(area.in_pixel(x + block_x(i), y + block_y(i))));
  }
  return areas;
}

/// Tests and writes the pixels of a smooth primitive in a tile with one sample per pixel.
template <class Writer>
void rasterize_smooth(const DrawInTile& d, const Triangle& t, TriangleId id, PacketQueue& queue, PassStatistics& statistics) {
  Writer writer(d, &queue, statistics);
  writer.begin(t);
  const SmoothArea area(d.draw, t);
  const PixelBounds bounds = area.pixels(d.bounds);
  const LargeDepthPlane plane(t, d.draw, d.tile, kPixelCenter);
  const DepthBounds range = depth_bounds(t, d.draw, d.tile.depth_format);
  const int x0 = bounds.x0 - d.tile.x0, y0 = bounds.y0 - d.tile.y0, x1 = bounds.x1 - d.tile.x0, y1 = bounds.y1 - d.tile.y0;
  for (int y = y0 / kPacketHeight * kPacketHeight; y < y1; y += kPacketHeight) {
    for (int x = x0 / kPacketWidth * kPacketWidth; x < x1; x += kPacketWidth) {
      const int packet = packet_at(x, y);
      const Int px = lane_x() + x, py = lane_y() + y;
      const uint32_t inside = bits((px >= Int(x0)) & (px < Int(x1)) & (py >= Int(y0)) & (py < Int(y1)));
      const PacketMask all{static_cast<uint16_t>(packet), static_cast<uint16_t>(inside)};
      const uint32_t lanes = bits(areas_in_packet(area, d.tile, all) > Real(0.0f));
      if (lanes == 0) continue;
      const auto z_at = [&] { return clamp(plane.at(px, py), Real(range.low), Real(range.high)); };
      if (writer.write(id, packet, lanes, z_at) && writer.writes_depth())
        widen_hiz(writer.compare_op(), d.tile, packet / kPacketsPerBlock, range);
    }
  }
}

}  // namespace halfspace::HS_LANES
