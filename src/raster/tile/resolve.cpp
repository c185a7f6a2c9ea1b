// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/resolve.h"

#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the mean of `samples` colors. They are added pairwise. If all are the same and their sum is finite, the mean is exactly that
// color.
HS_INLINE PacketColor mean_of(std::array<PacketColor, kMaxSamples>& colors, int samples) {
  for (auto n = static_cast<std::size_t>(samples); n > 1; n /= 2) {
    for (std::size_t i = 0; i < n / 2; ++i) {
      for (std::size_t k = 0; k < 4; ++k) colors[i][k] = colors[2 * i][k] + colors[2 * i + 1][k];
    }
  }
  PacketColor mean = colors[0];
  const Real share(1.0f / static_cast<float>(samples));
  for (Real& x : mean) x = x * share;
  return mean;
}

// The distance, in packets, from the pixels of sample 0 to those of each sample.
std::array<int, kMaxSamples> sample_shifts(const Tile& tile) {
  std::array<int, kMaxSamples> shifts{};
  for (int s = 0; s < tile.samples; ++s) shifts[static_cast<std::size_t>(s)] = packet_shift(sample_plane(tile.samples, s, tile.size));
  return shifts;
}

template <class F>
void for_each_packet(const Tile& tile, F f) {
  for (int p = 0; p < kPackets; ++p) {
    if (packet_x(p) < tile.width && packet_y(p) < tile.height) f(p);
  }
}

// For formats with one word per pixel. Packets whose samples have the same color are already resolved.
template <ColorFormat format>
void resolve_words(const Tile& tile, ColorBuffer& color) {
  const auto samples = static_cast<std::size_t>(tile.samples);
  const std::array<int, kMaxSamples> shifts = sample_shifts(tile);
  for_each_packet(tile, [&](int p) {
    const auto first_pixel = [&](std::size_t s) { return static_cast<std::size_t>(p + shifts[s]) * kLanes; };
    int32_t* words = plane<int32_t>(color, 0);
    const Int first = load<Int>(words + first_pixel(0));
    Mask same(true);
    for (std::size_t s = 1; s < samples; ++s) same = same & (load<Int>(words + first_pixel(s)) == first);
    if (all(same)) return;
    std::array<PacketColor, kMaxSamples> colors;
    for (std::size_t s = 0; s < samples; ++s) {
      for (int k = 0; k < 4; ++k) colors[s][static_cast<std::size_t>(k)] = read_channel<format>(color, first_pixel(s), k);
    }
    store(words + first_pixel(0), packed_codes<format>(mean_of(colors, tile.samples)));
  });
}

}  // namespace

void resolve_color(const Tile& tile, ColorBuffer& color) {
  if (tile.samples == 1 || color.format == ColorFormat::none || is_integer(color.format)) return;
  if (color.format == ColorFormat::rgba8) return resolve_words<ColorFormat::rgba8>(tile, color);
  if (color.format == ColorFormat::srgb8a8) return resolve_words<ColorFormat::srgb8a8>(tile, color);
  const std::array<int, kMaxSamples> shifts = sample_shifts(tile);
  for_each_packet(tile, [&](int p) {
    std::array<PacketColor, kMaxSamples> colors;
    for (std::size_t s = 0; s < static_cast<std::size_t>(tile.samples); ++s) colors[s] = read_color(color, p + shifts[s]);
    // Where all samples of a channel are the same, the sum of large values can be infinite, but the mean is not.
    const PacketColor first = read_color(color, p);
    std::array<Mask, 4> same{Mask(true), Mask(true), Mask(true), Mask(true)};
    for (std::size_t s = 0; s < static_cast<std::size_t>(tile.samples); ++s) {
      for (std::size_t k = 0; k < 4; ++k) same[k] = same[k] & (as_int(colors[s][k]) == as_int(first[k]));
    }
    if (all(same[0] & same[1] & same[2] & same[3])) return;  // the pixels of sample 0 already have this color
    PacketColor mean = mean_of(colors, tile.samples);
    for (std::size_t k = 0; k < 4; ++k) mean[k] = select(same[k], first[k], mean[k]);
    write_color(color, p, Mask(true), mean, mean, {});
  });
}

}  // namespace halfspace::HS_LANES
