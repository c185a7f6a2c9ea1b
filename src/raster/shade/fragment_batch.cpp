// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/fragment_batch.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/visibility/packed_pixels.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

void constant_colors(const Draw& draw, FragmentOutput& out) { draw.kernels.fragment(draw.shader.get(), {{.count = 1}, &out}); }

void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile) {
  const PacketColor* second = &out.packet_color(draw.kernels.color_count > 1 ? 1 : 0, i);
  for (int n = 0; n < std::min(tile.color_count, draw.kernels.color_count); ++n) {
    const auto at = static_cast<std::size_t>(n);
    if (tile.color[at].format == ColorFormat::none) continue;
    write_batch(tile.color[at], packets, &out.packet_color(at, i), second, {blend_of(draw.state, at), color_mask_of(draw.state, at)});
  }
}

void write_packed(const FragmentOutput& packed, std::span<const PacketMask> packets, const WriteTarget& to) {
  std::size_t pixel = 0;
  for (const PacketMask& p : packets) {
    const auto channel = [&](std::size_t c) { return unpack_values(packed.color_plane(0, c), pixel, p.lanes); };
    to.program(*to.buffer, p, to.state, channel(0), channel(1), channel(2), channel(3));
    pixel += static_cast<std::size_t>(std::popcount(p.lanes));
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
