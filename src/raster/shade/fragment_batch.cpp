// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/fragment_batch.h"

#include <algorithm>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/logic_op.h"

namespace halfspace::HS_LANES {

void constant_colors(const Draw& draw, FragmentOutput& out) { draw.kernels.fragment(draw.shader.get(), {{.count = 1}, &out}); }

namespace {

// Writes colors to an attachment, with alpha set to 1 or by a logic operation.
void write_changed(const Draw& draw, const AttachmentState& state, const PacketColor* colors, const PacketColor* seconds,
                   std::span<const PacketMask> packets, ColorBuffer& buffer) {
  const bool sets_alpha = draw.sets_alpha_to_one && !is_integer(buffer.format);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    PacketColor color = colors[i], second = seconds[i];
    if (sets_alpha) color[3] = second[3] = Real(1.0f);
    const Mask mask = mask_from_bits<Mask>(packets[i].lanes);
    if (draw.state.logic_op) {
      write_logic_op(buffer, packets[i].packet, mask, color, *draw.state.logic_op, state.mask);
    } else {
      write_color(buffer, packets[i].packet, mask, color, second, state);
    }
  }
}

}  // namespace

void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile) {
  const PacketColor* second = &out.packet_color(draw.kernels.color_count > 1 ? 1 : 0, i);
  for (int n = 0; n < std::min(tile.color_count, draw.kernels.color_count); ++n) {
    const auto at = static_cast<std::size_t>(n);
    if (tile.color[at].format == ColorFormat::none) continue;
    const AttachmentState state{blend_of(draw.state, at), color_mask_of(draw.state, at)};
    if (draw.state.logic_op || draw.sets_alpha_to_one) {
      write_changed(draw, state, &out.packet_color(at, i), second, packets, tile.color[at]);
    } else {
      write_batch(tile.color[at], packets, &out.packet_color(at, i), second, state);
    }
  }
}

}  // namespace halfspace::HS_LANES
