// SPDX-License-Identifier: Apache-2.0
//
// Fills pixels of images with one color, or with the clear depth of the target, without using a tile.
#include <algorithm>
#include <bit>
#include <cstdlib>

#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/tile/tile_layout.h"

namespace halfspace::HS_LANES {

namespace {

// Fills memory with a 64-byte line, using streaming stores. bytes must be a multiple of 64.
void stream_lines(const std::byte* line, std::byte* out, std::size_t bytes) {
  const __m128i a = load<__m128i>(line), b = load<__m128i>(line + 16), c = load<__m128i>(line + 32), d = load<__m128i>(line + 48);
  for (std::size_t i = 0; i < bytes; i += 64) {
    auto* to = reinterpret_cast<__m128i*>(out + i);
    _mm_stream_si128(to, a);
    _mm_stream_si128(to + 1, b);
    _mm_stream_si128(to + 2, c);
    _mm_stream_si128(to + 3, d);
  }
}

// Fills a long run of words. rep stos writes complete cache lines without reading them first, and keeps them in the cache. For runs of some
// hundred KB or more, it is faster than streaming stores.
void fill_words(std::byte* out, uint32_t word, std::size_t words) {
  asm volatile("rep stosl" : "+D"(out), "+c"(words) : "a"(word) : "memory");
}
constexpr std::size_t kLongRun = std::size_t{64} << 10;  // in bytes

// Sets pixels of an image with one layer to the same value.
template <class T>
void fill_rows(T value, const TexelView& image, const PixelBounds& pixels) {
  auto bytes = static_cast<std::size_t>(pixels.x1 - pixels.x0) * sizeof(T);  // per run
  int runs = pixels.y1 - pixels.y0;
  // Address of the first run. Its row is the one at the lowest address, and the next run is in the row after it.
  const std::ptrdiff_t pitch = std::abs(image.row_pitch);
  std::byte* const first = image.at(pixels.x0, image.row_pitch < 0 ? pixels.y1 - 1 : pixels.y0);
  if (static_cast<std::ptrdiff_t>(bytes) == pitch) {  // complete rows are contiguous
    bytes *= static_cast<std::size_t>(runs);
    runs = 1;
  }
  const bool large = 64 % sizeof(T) == 0 && streams(image, sizeof(T));
  if constexpr (sizeof(T) == sizeof(uint32_t)) {
    if (large && runs == 1 && bytes >= kLongRun) return fill_words(first, std::bit_cast<uint32_t>(value), bytes / sizeof(T));
  }
  alignas(64) std::array<std::byte, 64> line;
  for (std::size_t i = 0; i + sizeof(T) <= 64; i += sizeof(T)) std::memcpy(&line[i], &value, sizeof(T));
  const bool stream = large && bytes % 64 == 0 && static_cast<std::size_t>(pixels.x0) * sizeof(T) % 64 == 0;
  for (int run = 0; run < runs; ++run) {
    std::byte* const out = first + run * pitch;
    if (stream) {
      stream_lines(line.data(), out, bytes);
    } else {
      for (std::size_t i = 0; i < bytes; i += sizeof(T)) std::memcpy(out + i, &value, sizeof(T));
    }
  }
}

template <class T>
void fill_layers(T value, const TexelView& image, const PixelBounds& pixels) {
  for (int layer = 0; layer < image.layers; ++layer) fill_rows(value, image.part_of_layers(layer), pixels);
}

}  // namespace

void fill_color(const ColorTarget& target, const PixelBounds& pixels, const PacketColor& color) {
  if (!is_stored(target) || target.data == nullptr) return;
  const PixelBytes pixel = encode_pixel(target.format, color);
  const auto fill = [&]<class T>(T value) {
    std::memcpy(&value, pixel.data(), sizeof(T));
    fill_layers(value, target_texels(target), pixels);
  };
  switch (bytes_per_pixel(target.format)) {
    case 1: return fill(uint8_t{});
    case 2: return fill(uint16_t{});
    case 3: return fill(std::array<uint8_t, 3>{});
    case 4: return fill(uint32_t{});
    case 6: return fill(std::array<uint16_t, 3>{});
    case 8: return fill(std::array<uint16_t, 4>{});
    case 12: return fill(std::array<float, 3>{});
    case 16: return fill(std::array<float, 4>{});
    default: return;
  }
}

void fill_depth(const DepthTarget& target, const PixelBounds& pixels) {
  if (!is_stored(target) || target.data == nullptr) return;
  const float clear = depth_value(depth_part(target.format), std::clamp(target.clear_value, 0.0f, 1.0f));
  with_codec(target.format, [&]<class C>(C) { fill_layers(C::store(clear, target.stencil_clear_value), target_texels(target), pixels); });
}

}  // namespace halfspace::HS_LANES
