// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/tile/tile_layout.h"

namespace halfspace::HS_LANES {

namespace {

template <class T, std::size_t channels>
void load_planes(const TexelView& image, const Tile& tile, ColorBuffer& color) {
  T* to = plane<T>(color, 0);
  for_each_pixel(tile, image, channels * sizeof(T), tile.samples, [&](std::size_t t, const std::byte* pixel) {
    for (std::size_t k = 0; k < channels; ++k) std::memcpy(&to[k * kMaxTilePixels + t], pixel + k * sizeof(T), sizeof(T));
  });
}

// For formats whose channels are not words.
void load_texels(const TexelView& image, const Tile& tile, ColorBuffer& color) {
  const auto bytes = static_cast<std::size_t>(bytes_per_pixel(color.format));
  float* to = plane<float>(color, 0);
  for_each_pixel(tile, image, bytes, tile.samples, [&](std::size_t t, const std::byte* texel) {
    const glm::vec4 value =
        is_integer(color.format) ? std::bit_cast<glm::vec4>(decode_integers(color.format, texel)) : decode_texel(color.format, texel);
    for (int k = 0; k < word_planes(color.format); ++k) to[static_cast<std::size_t>(k) * kMaxTilePixels + t] = value[k];
  });
}

// Loads a quad of pixels with four 16-bit channels: two pixels of each row, which are adjacent in the tile.
HS_INLINE void split_quad(const std::byte* row0, const std::byte* row1, uint16_t* to) {
  const __m128i a = load<__m128i>(row0), b = load<__m128i>(row1);
  const __m128i even = _mm_unpacklo_epi16(a, b), odd = _mm_unpackhi_epi16(a, b);  // r0 r2 g0 g2 …, r1 r3 g1 g3 …
  const __m128i red_green = _mm_unpacklo_epi16(even, odd), blue_alpha = _mm_unpackhi_epi16(even, odd);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), red_green);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + kMaxTilePixels), _mm_unpackhi_epi64(red_green, red_green));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 2 * kMaxTilePixels), blue_alpha);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 3 * kMaxTilePixels), _mm_unpackhi_epi64(blue_alpha, blue_alpha));
}

#ifdef __AVX2__
// Loads two quads.
HS_INLINE void split_two_quads(const std::byte* row0, const std::byte* row1, uint16_t* to) {
  const __m256i a = load<__m256i>(row0), b = load<__m256i>(row1);
  const __m256i even = _mm256_unpacklo_epi16(a, b), odd = _mm256_unpackhi_epi16(a, b);
  const __m256i red_green = _mm256_permute4x64_epi64(_mm256_unpacklo_epi16(even, odd), 0b11011000);
  const __m256i blue_alpha = _mm256_permute4x64_epi64(_mm256_unpackhi_epi16(even, odd), 0b11011000);
  store(to, _mm256_castsi256_si128(red_green));
  store(to + kMaxTilePixels, _mm256_extracti128_si256(red_green, 1));
  store(to + 2 * kMaxTilePixels, _mm256_castsi256_si128(blue_alpha));
  store(to + 3 * kMaxTilePixels, _mm256_extracti128_si256(blue_alpha, 1));
}
#endif

void load_half_planes(const TexelView& image, const Tile& tile, ColorBuffer& color) {
  uint16_t* to = plane<uint16_t>(color, 0);
#ifdef __AVX2__
  const auto two_quads = [&](std::size_t t, const std::byte* row0, const std::byte* row1) { split_two_quads(row0, row1, to + t); };
  if (for_each_two_rows<4>(tile, image, two_quads)) return;
#endif
  const auto quad = [&](std::size_t t, const std::byte* row0, const std::byte* row1) { split_quad(row0, row1, to + t); };
  if (!for_each_two_rows<2>(tile, image, quad)) load_planes<uint16_t, 4>(image, tile, color);
}

}  // namespace

void load_color(const ColorTarget& target, const Tile& tile, ColorBuffer& color) {
  color.format = target.format;
  if (target.format == ColorFormat::none) return;
  if (target.load == LoadOp::dont_care) {  // zeros, so that undrawn pixels are deterministic
    std::fill_n(color.bytes.data(), kMaxTilePixels * bytes_in_tile(target.format), std::byte{0});
    return;
  }
  if (target.load == LoadOp::clear) {
    fill_buffer(color, spread_color(target.clear_value));
    return;
  }
  const TexelView image = target_texels(target);
  if (target.format == ColorFormat::rgba16f) return load_half_planes(image, tile, color);
  if (word_planes(target.format) != 0 && !has_word_channels(target.format)) return load_texels(image, tile, color);
  switch (word_planes(target.format)) {
    case 2: return load_planes<float, 2>(image, tile, color);
    case 3: return load_planes<float, 3>(image, tile, color);
    case 4: return load_planes<float, 4>(image, tile, color);
    default: return copy_words<true>(tile, image, tile.samples, color.bytes.data());
  }
}

void load_depth(const DepthTarget& target, Tile& tile) {
  tile.depth_format = depth_part(target.format);
  tile.has_stencil = has_stencil(target.format);
  if (target.format == DepthFormat::none) return;
  const bool loads_depth = target.load == LoadOp::load;
  const bool loads_stencil = tile.has_stencil && stencil_load_of(target) == LoadOp::load;
  if (loads_depth || loads_stencil) {
    tile.depth.fill(0.0f);  // for pixels outside the target
    if (tile.has_stencil) tile.stencil.fill(0);
    with_codec(target.format, [&]<class C>(C) {
      using Image = typename C::Image;
      for_each_pixel(tile, target_texels(target), sizeof(Image), tile.samples, [&](std::size_t t, const std::byte* pixel) {
        Image value;
        std::memcpy(&value, pixel, sizeof value);
        C::load(value, tile.depth[t], tile.stencil[t]);
      });
    });
  }
  if (loads_depth) {
    for (int b = 0; b < kBlocks; ++b) refresh_hiz(tile, b);
  } else {
    const float clear = depth_value(tile.depth_format, std::clamp(target.clear_value, 0.0f, 1.0f));
    tile.depth.fill(clear);
    tile.hiz_min.fill(clear);
    tile.hiz_max.fill(clear);
    tile.hiz_is_stale.fill(false);
  }
  if (tile.has_stencil && !loads_stencil) tile.stencil.fill(target.stencil_clear_value);
}

}  // namespace halfspace::HS_LANES
