// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/tile/tile_layout.h"

namespace halfspace::HS_LANES {

namespace {

#ifdef __AVX2__
// The same as copy_words() for a full-size tile with one sample and a large image. Writes two rows of eight pixels at a time, with
// streaming stores.
void stream_words(const Tile& tile, int target_width, int target_height, const std::byte* in_tile, std::byte* in_image) {
  const __m256i rows = _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7);  // Z-order to two rows of four pixels
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
}
#endif

// Copies a tile to an image with 32 bits per pixel.
void store_words(const Tile& tile, int width, int height, ImageSamples stored, int samples, const std::byte* in_tile, std::byte* in_image) {
#ifdef __AVX2__
  const bool whole = tile.samples == 1 && tile.width == kMaxTileSize && tile.height == kMaxTileSize;
  if (whole && streams(in_image, width, height, 4)) return stream_words(tile, width, height, in_tile, in_image);
#endif
  copy_words<false>(tile, width, height, stored, samples, in_tile, in_image);
}

int stored_samples(const Tile& tile, ImageSamples stored) { return stored == ImageSamples::one ? 1 : tile.samples; }

template <class F>
HS_INLINE void for_each_store(const Tile& tile, const ImageLayout& p, F f) {
  for_each_pixel(tile, p.width, p.height, p.stored, stored_samples(tile, p.stored), f);
}

template <class T, std::size_t channels>
void store_planes(std::byte* data, const ImageLayout& place, const Tile& tile, const ColorBuffer& color) {
  T* image = reinterpret_cast<T*>(data);
  const T* from = plane<T>(color, 0);
  for_each_store(tile, place, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < channels; ++k) image[channels * i + k] = from[k * kMaxTilePixels + t];
  });
}

// For formats whose channels are not words. The values in the tile are exact, so encoding does not round. A texel that was only loaded
// keeps its bytes (texel_codec.h: encode_texel).
void store_texels(std::byte* image, const ImageLayout& place, const Tile& tile, const ColorBuffer& color) {
  const auto bytes = static_cast<std::size_t>(bytes_per_pixel(color.format));
  const float* from = plane<float>(color, 0);
  for_each_store(tile, place, [&](std::size_t t, std::size_t i) {
    glm::vec4 value(0.0f);
    for (int k = 0; k < word_planes(color.format); ++k) value[k] = from[static_cast<std::size_t>(k) * kMaxTilePixels + t];
    if (is_integer(color.format)) {
      encode_integers(color.format, std::bit_cast<glm::ivec4>(value), image + i * bytes);
    } else {
      encode_texel(color.format, value, image + i * bytes);
    }
  });
}

HS_INLINE void join_quad(const uint16_t* from, uint16_t* row0, uint16_t* row1) {
  const auto plane = [&](int k) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + k * kMaxTilePixels)); };
  const __m128i red_green = _mm_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm_unpackhi_epi32(red_green, blue_alpha));
}

#ifdef __AVX2__
// Stores two quads.
HS_INLINE void join_two_quads(const uint16_t* from, uint16_t* row0, uint16_t* row1) {
  // In each plane, the first quad is in the low half and the second one in the high half.
  const auto plane = [&](int k) {
    return _mm256_permute4x64_epi64(_mm256_castsi128_si256(load<__m128i>(from + k * kMaxTilePixels)), 0b11011000);
  };
  const __m256i red_green = _mm256_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm256_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm256_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm256_unpackhi_epi32(red_green, blue_alpha));
}
#endif

void store_half_planes(std::byte* data, const ImageLayout& place, const Tile& tile, const ColorBuffer& color) {
  auto* image = reinterpret_cast<uint16_t*>(data);
  const uint16_t* from = plane<uint16_t>(color, 0);
#ifdef __AVX2__
  const auto two_quads = [&](std::size_t t, std::size_t row0, std::size_t row1) { join_two_quads(from + t, image + row0, image + row1); };
  if (for_each_two_rows<4>(tile, place, two_quads)) return;
#endif
  const auto quad = [&](std::size_t t, std::size_t row0, std::size_t row1) { join_quad(from + t, image + row0, image + row1); };
  if (!for_each_two_rows<2>(tile, place, quad)) store_planes<uint16_t, 4>(data, place, tile, color);
}

}  // namespace

void store_color(const ColorTarget& target, int width, int height, ImageSamples stored, const Tile& tile, const ColorBuffer& color) {
  if (target.format == ColorFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  const ImageLayout place{width, height, stored};
  if (target.format == ColorFormat::rgba16f) return store_half_planes(target.data, place, tile, color);
  if (word_planes(target.format) != 0 && !has_word_channels(target.format)) return store_texels(target.data, place, tile, color);
  switch (word_planes(target.format)) {
    case 2: return store_planes<float, 2>(target.data, place, tile, color);
    case 3: return store_planes<float, 3>(target.data, place, tile, color);
    case 4: return store_planes<float, 4>(target.data, place, tile, color);
    default: return store_words(tile, width, height, stored, stored_samples(tile, stored), color.bytes.data(), target.data);
  }
}

void store_depth(const DepthTarget& target, int width, int height, ImageSamples stored, const Tile& tile) {
  if (target.format == DepthFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  if (target.format == DepthFormat::d32f) {  // stored as in the tile
    store_words(tile, width, height, stored, stored_samples(tile, stored), reinterpret_cast<const std::byte*>(tile.depth.data()),
                target.data);
    return;
  }
  with_codec(target.format, [&]<class C>(C) {
    auto* image = reinterpret_cast<typename C::Image*>(target.data);
    const bool stencil = tile.has_stencil;
    for_each_store(tile, {width, height, stored},
                   [&](std::size_t t, std::size_t i) { image[i] = C::store(tile.depth[t], stencil ? tile.stencil[t] : uint8_t{0}); });
  });
}

}  // namespace halfspace::HS_LANES
