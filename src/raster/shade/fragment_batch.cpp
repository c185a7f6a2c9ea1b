// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/fragment_batch.h"

#include <algorithm>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/blend.h"

namespace halfspace::HS_LANES {

void constant_colors(const Draw& draw, FragmentOutput& out) { draw.kernels.fragment(draw.shader.get(), {{.count = 1}, &out}); }

void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile) {
  const PacketColor* second = &out.packet_color(draw.kernels.color_count > 1 ? 1 : 0, i);
  for (int n = 0; n < std::min(tile.color_count, draw.kernels.color_count); ++n) {
    const auto at = static_cast<std::size_t>(n);
    if (tile.color[at].format == ColorFormat::none) continue;
    write_batch(tile.color[at], packets, &out.packet_color(at, i), second, {blend_of(draw.state, at), color_mask_of(draw.state, at)});
  }
}

}  // namespace halfspace::HS_LANES
