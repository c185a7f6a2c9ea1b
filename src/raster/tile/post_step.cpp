// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/post_step.h"

#include "halfspace/raster/tile/blend.h"

namespace halfspace::HS_LANES {

void run_post_step(const PostStep& post, const Tile& tile, ColorBuffer& scratch) {
  constexpr std::size_t kPostBatch = 16;
  scratch.format = post.target.format;
  std::array<PacketMask, kPostBatch> packets;
  std::array<PacketColor, kPostBatch> colors;
  std::size_t count = 0;
  for (int p = 0; p < kPackets; ++p) {
    const bool is_last = p == kPackets - 1;
    if (packet_x(p) < tile.width && packet_y(p) < tile.height)
      packets[count++] = {static_cast<uint16_t>(p), static_cast<uint16_t>(kAllBits<Mask>)};
    if (count < packets.size() && !is_last) continue;
    const std::span<const PacketMask> batch = std::span(packets).first(count);
    read_batch(tile.color[0], batch, colors.data());
    post.kernel(post.function.get(), {tile.x0, tile.y0, batch, colors.data()});
    write_batch(scratch, batch, colors.data(), colors.data(), {});
    count = 0;
  }
  store_color(post.target, tile, scratch);
}

}  // namespace halfspace::HS_LANES
