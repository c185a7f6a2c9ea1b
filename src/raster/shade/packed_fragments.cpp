// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/packed_fragments.h"

#include <bit>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

std::size_t unpack(const ShaderKernels& kernels, const FragmentOutput& packed, std::size_t first, std::span<const PacketMask> packets,
                   FragmentOutput& out) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const uint32_t lanes = packets[i].lanes;
    for (std::size_t n = 0; n < static_cast<std::size_t>(kernels.color_count); ++n) {
      for (std::size_t c = 0; c < 4; ++c) out.packet_color(n, i)[c] = unpack_values(packed.color_plane(n, c), first, lanes);
    }
    if (kernels.writes_depth) out.depth[i] = unpack_values(reinterpret_cast<const float*>(packed.depth.data()), first, lanes);
    if (kernels.discards) out.keep[i] = unpack_keep(packed.keep.data(), first, lanes);
    first += static_cast<std::size_t>(std::popcount(lanes));
  }
  return first;
}

void write_packed(const FragmentOutput& packed, std::span<const PacketMask> packets, const WriteTarget& to) {
  std::size_t pixel = 0;
  for (const PacketMask& p : packets) {
    const auto channel = [&](std::size_t c) { return unpack_values(packed.color_plane(0, c), pixel, p.lanes); };
    to.write(p, channel(0), channel(1), channel(2), channel(3));
    pixel += static_cast<std::size_t>(std::popcount(p.lanes));
  }
}

}  // namespace halfspace::HS_LANES
