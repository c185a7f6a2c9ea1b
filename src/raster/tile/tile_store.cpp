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
void stream_words(const Tile& tile, const TexelView& image, const std::byte* in_tile) {
  const __m256i rows = _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7);  // Z-order to two rows of four pixels
  for (int y = 0; y < kMaxTileSize; y += 2) {
    std::byte* out = image.data + (tile.y0 + y) * image.row_pitch + static_cast<std::size_t>(tile.x0) * 4;
    for (int x = 0; x < kMaxTileSize; x += kBlockSize, out += 4 * kBlockSize) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::byte* from = in_tile + 4 * (block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)]);
      const __m256i left = _mm256_permutevar8x32_epi32(load<__m256i>(from), rows);
      const __m256i right = _mm256_permutevar8x32_epi32(load<__m256i>(from + 4 * 16), rows);
      _mm256_stream_si256(reinterpret_cast<__m256i*>(out), _mm256_permute2x128_si256(left, right, 0x20));
      _mm256_stream_si256(reinterpret_cast<__m256i*>(out + image.row_pitch), _mm256_permute2x128_si256(left, right, 0x31));
    }
  }
}
#endif

// Copies a tile to an image with 32 bits per pixel.
void store_words(const Tile& tile, const TexelView& image, const std::byte* in_tile) {
#ifdef __AVX2__
  const bool whole = tile.samples == 1 && tile.width == kMaxTileSize && tile.height == kMaxTileSize;
  if (whole && streams(image, 4)) return stream_words(tile, image, in_tile);
#endif
  copy_words<false>(tile, image, image.layers, in_tile);
}

template <class T, std::size_t channels>
void store_planes(const TexelView& image, const Tile& tile, const ColorBuffer& color) {
  const T* from = plane<T>(color, 0);
  for_each_pixel(tile, image, channels * sizeof(T), image.layers, [&](std::size_t t, std::byte* pixel) {
    for (std::size_t k = 0; k < channels; ++k) std::memcpy(pixel + k * sizeof(T), &from[k * kMaxTilePixels + t], sizeof(T));
  });
}

// For formats whose channels are not words. The values in the tile are exact, so encoding does not round. A texel that was only loaded
// keeps its bytes (texel_codec.h: encode_texel).
void store_texels(const TexelView& image, const Tile& tile, const ColorBuffer& color) {
  const auto bytes = static_cast<std::size_t>(bytes_per_pixel(color.format));
  const float* from = plane<float>(color, 0);
  for_each_pixel(tile, image, bytes, image.layers, [&](std::size_t t, std::byte* texel) {
    glm::vec4 value(0.0f);
    for (int k = 0; k < word_planes(color.format); ++k) value[k] = from[static_cast<std::size_t>(k) * kMaxTilePixels + t];
    if (is_integer(color.format)) {
      encode_integers(color.format, std::bit_cast<glm::ivec4>(value), texel);
    } else {
      encode_texel(color.format, value, texel);
    }
  });
}

HS_INLINE void join_quad(const uint16_t* from, std::byte* row0, std::byte* row1) {
  const auto plane = [&](int k) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + k * kMaxTilePixels)); };
  const __m128i red_green = _mm_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm_unpackhi_epi32(red_green, blue_alpha));
}

#ifdef __AVX2__
// Stores two quads.
HS_INLINE void join_two_quads(const uint16_t* from, std::byte* row0, std::byte* row1) {
  // In each plane, the first quad is in the low half and the second one in the high half.
  const auto plane = [&](int k) {
    return _mm256_permute4x64_epi64(_mm256_castsi128_si256(load<__m128i>(from + k * kMaxTilePixels)), 0b11011000);
  };
  const __m256i red_green = _mm256_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm256_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm256_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm256_unpackhi_epi32(red_green, blue_alpha));
}
#endif

void store_half_planes(const TexelView& image, const Tile& tile, const ColorBuffer& color) {
  const uint16_t* from = plane<uint16_t>(color, 0);
#ifdef __AVX2__
  const auto two_quads = [&](std::size_t t, std::byte* row0, std::byte* row1) { join_two_quads(from + t, row0, row1); };
  if (for_each_two_rows<4>(tile, image, two_quads)) return;
#endif
  const auto quad = [&](std::size_t t, std::byte* row0, std::byte* row1) { join_quad(from + t, row0, row1); };
  if (!for_each_two_rows<2>(tile, image, quad)) store_planes<uint16_t, 4>(image, tile, color);
}

}  // namespace

void store_color(const ColorTarget& target, const Tile& tile, const ColorBuffer& color) {
  if (target.format == ColorFormat::none || !is_stored(target) || target.data == nullptr) return;
  const TexelView image = target_texels(target);
  if (target.format == ColorFormat::rgba16f) return store_half_planes(image, tile, color);
  if (word_planes(target.format) != 0 && !has_word_channels(target.format)) return store_texels(image, tile, color);
  switch (word_planes(target.format)) {
    case 2: return store_planes<float, 2>(image, tile, color);
    case 3: return store_planes<float, 3>(image, tile, color);
    case 4: return store_planes<float, 4>(image, tile, color);
    default: return store_words(tile, image, color.bytes.data());
  }
}

void store_depth(const DepthTarget& target, const Tile& tile) {
  if (target.format == DepthFormat::none || !is_stored(target) || target.data == nullptr) return;
  const TexelView image = target_texels(target);
  if (target.format == DepthFormat::d32f)  // stored as in the tile
    return store_words(tile, image, reinterpret_cast<const std::byte*>(tile.depth.data()));
  with_codec(target.format, [&]<class C>(C) {
    for_each_pixel(tile, image, sizeof(typename C::Image), image.layers, [&](std::size_t t, std::byte* pixel) {
      const typename C::Image value = C::store(tile.depth[t], tile.stencil[t]);
      std::memcpy(pixel, &value, sizeof value);
    });
  });
}

}  // namespace halfspace::HS_LANES
