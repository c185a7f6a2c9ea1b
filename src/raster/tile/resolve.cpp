// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/resolve.h"

namespace halfspace {

void resolve_color(const Tile& tile, ColorBuffer& color) {
  if (tile.samples == 1 || color.format == ColorFormat::none || color.format == ColorFormat::r32ui) return;
  const Real share(1.0f / static_cast<float>(tile.samples));
  for (int p = 0; p < kPackets; ++p) {
    if (packet_x(p) >= tile.width || packet_y(p) >= tile.height) continue;
    std::array<PacketColor, kMaxSamples> sums;
    for (int s = 0; s < tile.samples; ++s) {
      sums[static_cast<std::size_t>(s)] = read_color(color, p + packet_shift(sample_plane(tile.samples, s, tile.size)));
    }
    // Samples are added pairwise. If all have the same color, the mean is exactly that color.
    for (auto n = static_cast<std::size_t>(tile.samples); n > 1; n /= 2) {
      for (std::size_t i = 0; i < n / 2; ++i) {
        for (std::size_t k = 0; k < 4; ++k) sums[i][k] = sums[2 * i][k] + sums[2 * i + 1][k];
      }
    }
    PacketColor mean = sums[0];
    for (Real& x : mean) x = x * share;
    write_color(color, p, Mask(true), mean, mean, {});
  }
}

}  // namespace halfspace
