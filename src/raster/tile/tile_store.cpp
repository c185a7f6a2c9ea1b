// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile_layout.h"

namespace halfspace {

namespace {

// Images from this size on are larger than the caches next to a core: what is written to them goes past these, which saves
// reading each line first.
constexpr std::size_t kStreamBytes = std::size_t{4} << 20;

bool streams(const std::byte* data, int width, int height, int bytes) {
  const auto row = static_cast<std::size_t>(width) * static_cast<std::size_t>(bytes);
  return row * static_cast<std::size_t>(height) >= kStreamBytes && row % 64 == 0 && reinterpret_cast<uintptr_t>(data) % 64 == 0;
}

#ifdef __AVX2__
// copy_words to a large image, of a whole tile of one sample: two rows of eight pixels at a time.
void stream_words(const Tile& tile, int target_width, int target_height, const std::byte* in_tile, std::byte* in_image) {
  const __m256i rows = _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7);  // Z order to one row of four and the next
  const std::size_t pitch = static_cast<std::size_t>(target_width) * 4;
  for (int y = 0; y < kMaxTileSize; y += 2) {
    std::byte* out = in_image + static_cast<std::size_t>(target_height - 1 - (tile.y0 + y)) * pitch + static_cast<std::size_t>(tile.x0) * 4;
    for (int x = 0; x < kMaxTileSize; x += kBlockSize, out += 4 * kBlockSize) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::byte* from = in_tile + 4 * (block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)]);
      const __m256i left = _mm256_permutevar8x32_epi32(load<__m256i>(from), rows);
      const __m256i right = _mm256_permutevar8x32_epi32(load<__m256i>(from + 4 * 16), rows);
      _mm256_stream_si256(reinterpret_cast<__m256i*>(out), _mm256_permute2x128_si256(left, right, 0x20));
      _mm256_stream_si256(reinterpret_cast<__m256i*>(out - pitch), _mm256_permute2x128_si256(left, right, 0x31));
    }
  }
  _mm_sfence();  // streamed stores are not ordered before the end of the task by anything else
}
#endif

// Tile to image, 32 bits a pixel.
void store_words(const Tile& tile, int width, int height, Samples held, int samples, const std::byte* in_tile, std::byte* in_image) {
#ifdef __AVX2__
  const bool whole = tile.samples == 1 && tile.width == kMaxTileSize && tile.height == kMaxTileSize;
  if (whole && streams(in_image, width, height, 4)) return stream_words(tile, width, height, in_tile, in_image);
#endif
  copy_words<false>(tile, width, height, held, samples, in_tile, in_image);
}

int stored_samples(const Tile& tile, Samples held) { return held == Samples::one ? 1 : tile.samples; }

template <class F>
HS_INLINE void for_each_store(const Tile& tile, const ImagePlace& p, F f) {
  for_each_pixel(tile, p.width, p.height, p.held, stored_samples(tile, p.held), f);
}

template <class T>
void store_planes(std::byte* data, const ImagePlace& place, const Tile& tile, const ColorBuffer& color) {
  T* image = reinterpret_cast<T*>(data);
  const T* from = planes<T>(color);
  for_each_store(tile, place, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) image[4 * i + k] = from[k * kMaxTilePixels + t];
  });
}

HS_INLINE void join_quad(const uint16_t* from, uint16_t* row0, uint16_t* row1) {
  const auto plane = [&](int k) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + k * kMaxTilePixels)); };
  const __m128i red_green = _mm_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm_unpackhi_epi32(red_green, blue_alpha));
}

#ifdef __AVX2__
// Two quads at once.
HS_INLINE void join_two_quads(const uint16_t* from, uint16_t* row0, uint16_t* row1) {
  // of a plane: the first quad in the low half, the second in the high one
  const auto plane = [&](int k) {
    return _mm256_permute4x64_epi64(_mm256_castsi128_si256(load<__m128i>(from + k * kMaxTilePixels)), 0b11011000);
  };
  const __m256i red_green = _mm256_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm256_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm256_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm256_unpackhi_epi32(red_green, blue_alpha));
}
#endif

void store_half_planes(std::byte* data, const ImagePlace& place, const Tile& tile, const ColorBuffer& color) {
  auto* image = reinterpret_cast<uint16_t*>(data);
  const uint16_t* from = planes<uint16_t>(color);
#ifdef __AVX2__
  const auto two_quads = [&](std::size_t t, std::size_t row0, std::size_t row1) { join_two_quads(from + t, image + row0, image + row1); };
  if (for_each_two_rows<4>(tile, place, two_quads)) return;
#endif
  const auto quad = [&](std::size_t t, std::size_t row0, std::size_t row1) { join_quad(from + t, image + row0, image + row1); };
  if (!for_each_two_rows<2>(tile, place, quad)) store_planes<uint16_t>(data, place, tile, color);
}

// Fills bytes, a multiple of 64, with a line of 64.
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

// Fills a long run of words. The processor's own loop writes whole cache lines without reading them first, and leaves them in the cache:
// where it has some hundred KB before it, it is faster than stores past the caches.
void fill_words(std::byte* out, uint32_t word, std::size_t words) {
  asm volatile("rep stosl" : "+D"(out), "+c"(words) : "a"(word) : "memory");
}
constexpr std::size_t kLongRun = std::size_t{64} << 10;  // bytes

// Sets pixels of an image to one value.
template <class T>
void fill_rows(T value, std::byte* data, int width, int height, const PixelBounds& pixels) {
  const auto at = [&](int y) {
    return data +
           (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(pixels.x0)) * sizeof(T);
  };
  auto bytes = static_cast<std::size_t>(pixels.x1 - pixels.x0) * sizeof(T);  // of a run
  int runs = pixels.y1 - pixels.y0;
  if (pixels.x1 - pixels.x0 == width) {  // rows that follow each other
    bytes *= static_cast<std::size_t>(runs);
    runs = 1;
  }
  const bool large = streams(data, width, height, sizeof(T));
  if constexpr (sizeof(T) == sizeof(uint32_t)) {
    if (large && runs == 1 && bytes >= kLongRun) return fill_words(at(pixels.y1 - 1), std::bit_cast<uint32_t>(value), bytes / sizeof(T));
  }
  alignas(64) std::array<std::byte, 64> line;
  for (std::size_t i = 0; i < 64; i += sizeof(T)) std::memcpy(&line[i], &value, sizeof(T));
  const bool stream = large && bytes % 64 == 0 && static_cast<std::size_t>(pixels.x0) * sizeof(T) % 64 == 0;
  for (int y = pixels.y1 - runs; y < pixels.y1; ++y) {
    if (stream) {
      stream_lines(line.data(), at(y), bytes);
    } else {
      std::fill_n(reinterpret_cast<T*>(at(y)), bytes / sizeof(T), value);
    }
  }
  if (stream) _mm_sfence();
}

}  // namespace

void fill_color(const ColorTarget& target, int width, int height, const PixelBounds& pixels, const PacketColor& color) {
  if (target.store == StoreOp::dont_care || target.data == nullptr) return;
  ColorBuffer one;
  one.format = target.format;
  write_color(one, 0, Mask(true), color, color, {});
  switch (target.format) {
    case ColorFormat::none: return;
    case ColorFormat::rgba8:
    case ColorFormat::srgb8a8: return fill_rows(*planes<uint32_t>(one), target.data, width, height, pixels);
    case ColorFormat::rgba16f: {
      const uint16_t* p = planes<uint16_t>(one);
      return fill_rows(std::array<uint16_t, 4>{p[0], p[kMaxTilePixels], p[2 * kMaxTilePixels], p[3 * kMaxTilePixels]}, target.data, width,
                       height, pixels);
    }
    case ColorFormat::rgba32f: {
      const float* p = planes<float>(one);
      return fill_rows(std::array<float, 4>{p[0], p[kMaxTilePixels], p[2 * kMaxTilePixels], p[3 * kMaxTilePixels]}, target.data, width,
                       height, pixels);
    }
  }
}

void fill_depth(const DepthTarget& target, int width, int height, const PixelBounds& pixels) {
  if (target.store == StoreOp::dont_care || target.data == nullptr) return;
  const float clear = depth_value(depth_part(target.format), std::clamp(target.clear_value, 0.0f, 1.0f));
  with_codec(target.format,
             [&]<class C>(C) { fill_rows(C::store(clear, target.stencil_clear_value), target.data, width, height, pixels); });
}

void store_color(const ColorTarget& target, int width, int height, Samples held, const Tile& tile, const ColorBuffer& color) {
  if (target.format == ColorFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  const ImagePlace place{width, height, held};
  switch (target.format) {
    case ColorFormat::rgba32f: store_planes<float>(target.data, place, tile, color); break;
    case ColorFormat::rgba16f: store_half_planes(target.data, place, tile, color); break;
    default: store_words(tile, width, height, held, stored_samples(tile, held), color.bytes.data(), target.data); break;
  }
}

void store_depth(const DepthTarget& target, int width, int height, Samples held, const Tile& tile) {
  if (target.format == DepthFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  if (target.format == DepthFormat::d32f) {  // as the tile holds it
    store_words(tile, width, height, held, stored_samples(tile, held), reinterpret_cast<const std::byte*>(tile.depth.data()), target.data);
    return;
  }
  with_codec(target.format, [&]<class C>(C) {
    auto* image = reinterpret_cast<typename C::Image*>(target.data);
    const bool stencil = tile.has_stencil;
    for_each_store(tile, {width, height, held},
                   [&](std::size_t t, std::size_t i) { image[i] = C::store(tile.depth[t], stencil ? tile.stencil[t] : uint8_t{0}); });
  });
}

}  // namespace halfspace
