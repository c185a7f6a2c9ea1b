// SPDX-License-Identifier: Apache-2.0
#include "raster/tile.h"

#include <algorithm>
#include <cstring>

#include "raster/output.h"

namespace halfspace {

namespace {

constexpr std::array<uint8_t, kPixelsPerBlock> make_z_order() {
  std::array<uint8_t, kPixelsPerBlock> place{};
  for (int i = 0; i < kPixelsPerBlock; ++i) place[static_cast<std::size_t>(block_y(i) * kBlockSize + block_x(i))] = static_cast<uint8_t>(i);
  return place;
}
// Where pixel (x, y) of a block lies: [8·y + x].
constexpr std::array<uint8_t, kPixelsPerBlock> kZOrder = make_z_order();

// Calls f(pixel of the tile, pixel of the image, count) for every row of every block, cut to the target: count pixels, whose
// places in the tile are the first one's plus kZOrder[0 … count − 1]. So for every sample; images of one sample give and
// take the first one's.
template <class F>
HS_INLINE void for_each_row(const Tile& tile, int target_width, int target_height, Samples held, int samples, F f) {
  for (int s = 0; s < samples; ++s) {
    const SampleCell cell = sample_cell(tile.samples, s, tile.size);
    const std::size_t shift = static_cast<std::size_t>(packet_shift(cell)) * kLanes;
    const std::size_t image = held == Samples::one ? 0 : static_cast<std::size_t>(s) * static_cast<std::size_t>(target_height);
    for (int y = 0; y < tile.height; ++y) {
      const std::size_t row =
          (image + static_cast<std::size_t>(target_height - 1 - (tile.y0 + y))) * static_cast<std::size_t>(target_width);
      const std::size_t out = row + static_cast<std::size_t>(tile.x0);
      for (int x = 0; x < tile.width; x += kBlockSize) {
        const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
        f(shift + block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)], out + static_cast<std::size_t>(x),
          std::min(kBlockSize, tile.width - x));
      }
    }
  }
}

// Calls f(pixel of the tile, pixel of the image) for each.
template <class F>
HS_INLINE void for_each_pixel(const Tile& tile, int target_width, int target_height, Samples held, int samples, F f) {
  for_each_row(tile, target_width, target_height, held, samples, [&](std::size_t first, std::size_t out, int pixels) {
    if (pixels == kBlockSize) {  // places known when compiling
      for (std::size_t i = 0; i < kBlockSize; ++i) f(first + kZOrder[i], out + i);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) f(first + kZOrder[i], out + i);
    }
  });
}

// for_each_pixel for images of 32 bits a pixel: two neighbours, which lie side by side in both, at a time. load: image to
// tile, else tile to image.
template <bool load, class TileBytes, class ImageBytes>
void copy_words(const Tile& tile, int target_width, int target_height, Samples held, int samples, TileBytes* in_tile, ImageBytes* in_image) {
  const auto copy = [&]<std::size_t bytes>(std::integral_constant<std::size_t, bytes>, std::size_t t, std::size_t i) {
    if constexpr (load) {
      std::memcpy(in_tile + 4 * t, in_image + 4 * i, bytes);
    } else {
      std::memcpy(in_image + 4 * i, in_tile + 4 * t, bytes);
    }
  };
  for_each_row(tile, target_width, target_height, held, samples, [&](std::size_t first, std::size_t out, int pixels) {
    if (pixels == kBlockSize) {
      for (std::size_t i = 0; i < kBlockSize; i += 2) copy(std::integral_constant<std::size_t, 8>(), first + kZOrder[i], out + i);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) {
        copy(std::integral_constant<std::size_t, 4>(), first + kZOrder[i], out + i);
      }
    }
  });
}

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

// An image that a tile is loaded from or stored to.
struct ImagePlace {
  int width, height;
  Samples held;
};
template <class F>
HS_INLINE void for_each_load(const Tile& tile, const ImagePlace& p, F f) {
  for_each_pixel(tile, p.width, p.height, p.held, tile.samples, f);
}
template <class F>
HS_INLINE void for_each_store(const Tile& tile, const ImagePlace& p, F f) {
  for_each_pixel(tile, p.width, p.height, p.held, stored_samples(tile, p.held), f);
}

// Planes of T in the tile ↔ T[4] a pixel in the image.
template <class T>
T* planes(ColorBuffer& b) {
  return reinterpret_cast<T*>(b.bytes.data());
}
template <class T>
const T* planes(const ColorBuffer& b) {
  return reinterpret_cast<const T*>(b.bytes.data());
}

template <class T>
void load_planes(const std::byte* data, const ImagePlace& place, const Tile& tile, ColorBuffer& color) {
  const T* image = reinterpret_cast<const T*>(data);
  T* to = planes<T>(color);
  for_each_load(tile, place, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) to[k * kMaxTilePixels + t] = image[4 * i + k];
  });
}

template <class T>
void store_planes(std::byte* data, const ImagePlace& place, const Tile& tile, const ColorBuffer& color) {
  T* image = reinterpret_cast<T*>(data);
  const T* from = planes<T>(color);
  for_each_store(tile, place, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) image[4 * i + k] = from[k * kMaxTilePixels + t];
  });
}

// Pixels of four 16-bit values, a quad at a time: two pixels of a row above two of the next, side by side in the tile.
HS_INLINE void split_quad(const uint16_t* row0, const uint16_t* row1, uint16_t* to) {
  const __m128i a = load<__m128i>(row0), b = load<__m128i>(row1);
  const __m128i even = _mm_unpacklo_epi16(a, b), odd = _mm_unpackhi_epi16(a, b);  // r0 r2 g0 g2 …, r1 r3 g1 g3 …
  const __m128i red_green = _mm_unpacklo_epi16(even, odd), blue_alpha = _mm_unpackhi_epi16(even, odd);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), red_green);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + kMaxTilePixels), _mm_unpackhi_epi64(red_green, red_green));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 2 * kMaxTilePixels), blue_alpha);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 3 * kMaxTilePixels), _mm_unpackhi_epi64(blue_alpha, blue_alpha));
}
HS_INLINE void join_quad(const uint16_t* from, uint16_t* row0, uint16_t* row1) {
  const auto plane = [&](int k) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + k * kMaxTilePixels)); };
  const __m128i red_green = _mm_unpacklo_epi16(plane(0), plane(1)), blue_alpha = _mm_unpacklo_epi16(plane(2), plane(3));
  store(row0, _mm_unpacklo_epi32(red_green, blue_alpha));
  store(row1, _mm_unpackhi_epi32(red_green, blue_alpha));
}
// Calls f(first pixel of a quad in the tile, and of its two rows in the image); images of one sample, the first one's.
// False, and nothing is done, if the tile has half a quad.
template <class F>
HS_INLINE bool for_each_quad(const Tile& tile, const ImagePlace& place, F f) {
  if (tile.samples != 1 || (tile.width | tile.height) % 2 != 0) return false;
  for (int y = 0; y < tile.height; y += 2) {
    const std::size_t row = static_cast<std::size_t>(place.height - 1 - (tile.y0 + y)) * static_cast<std::size_t>(place.width);
    for (int x = 0; x < tile.width; x += 2) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::size_t in_tile = block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize + x % kBlockSize)];
      const std::size_t in_image = row + static_cast<std::size_t>(tile.x0 + x);
      f(in_tile, 4 * in_image, 4 * (in_image - static_cast<std::size_t>(place.width)));
    }
  }
  return true;
}

void load_half_planes(const std::byte* data, const ImagePlace& place, const Tile& tile, ColorBuffer& color) {
  const auto* image = reinterpret_cast<const uint16_t*>(data);
  uint16_t* to = planes<uint16_t>(color);
  const auto quad = [&](std::size_t t, std::size_t row0, std::size_t row1) { split_quad(image + row0, image + row1, to + t); };
  if (!for_each_quad(tile, place, quad)) load_planes<uint16_t>(data, place, tile, color);
}

void store_half_planes(std::byte* data, const ImagePlace& place, const Tile& tile, const ColorBuffer& color) {
  auto* image = reinterpret_cast<uint16_t*>(data);
  const uint16_t* from = planes<uint16_t>(color);
  const auto quad = [&](std::size_t t, std::size_t row0, std::size_t row1) { join_quad(from + t, image + row0, image + row1); };
  if (!for_each_quad(tile, place, quad)) store_planes<uint16_t>(data, place, tile, color);
}

// One pixel's depth and stencil, as an image holds them and as a tile does.
struct Depth16 {
  using Image = uint16_t;
  static void load(Image i, float& depth, uint8_t&) { depth = static_cast<float>(i); }
  static Image store(float depth, uint8_t) { return static_cast<Image>(depth); }
};
struct Depth24 {
  using Image = uint32_t;
  static void load(Image i, float& depth, uint8_t&) { depth = static_cast<float>(i); }
  static Image store(float depth, uint8_t) { return static_cast<Image>(depth); }
};
struct Depth32 {
  using Image = float;
  static void load(Image i, float& depth, uint8_t&) { depth = i; }
  static Image store(float depth, uint8_t) { return depth; }
};
struct Depth24Stencil8 {
  using Image = uint32_t;
  static void load(Image i, float& depth, uint8_t& stencil) {
    depth = static_cast<float>(i >> 8);
    stencil = static_cast<uint8_t>(i);
  }
  static Image store(float depth, uint8_t stencil) { return static_cast<Image>(depth) << 8 | stencil; }
};
struct Depth32Stencil8 {
  using Image = DepthStencil;
  static void load(const Image& i, float& depth, uint8_t& stencil) {
    depth = i.depth;
    stencil = static_cast<uint8_t>(i.stencil);
  }
  static Image store(float depth, uint8_t stencil) { return {depth, stencil}; }
};

// Calls f with the codec of a format.
template <class F>
void with_codec(DepthFormat format, F f) {
  switch (format) {
    case DepthFormat::none: return;
    case DepthFormat::d16: return f(Depth16{});
    case DepthFormat::d24: return f(Depth24{});
    case DepthFormat::d32f: return f(Depth32{});
    case DepthFormat::d24s8: return f(Depth24Stencil8{});
    case DepthFormat::d32fs8: return f(Depth32Stencil8{});
  }
}

// Sets all pixels to the first.
void repeat_first_pixel(ColorBuffer& color) {
  const auto repeat = []<class T>(T* values, int count) { std::fill_n(values, count, *values); };
  switch (color.format) {
    case ColorFormat::rgba32f:
      for (int k = 0; k < 4; ++k) repeat(planes<float>(color) + k * kMaxTilePixels, kMaxTilePixels);
      break;
    case ColorFormat::rgba16f:
      for (int k = 0; k < 4; ++k) repeat(planes<uint16_t>(color) + k * kMaxTilePixels, kMaxTilePixels);
      break;
    default: repeat(planes<uint32_t>(color), kMaxTilePixels); break;
  }
}

}  // namespace

void load_color(const ColorTarget& target, int width, int height, Samples held, const Tile& tile, ColorBuffer& color) {
  color.format = target.format;
  if (target.format == ColorFormat::none) return;
  if (target.load == LoadOp::dont_care) {  // zeros, so that even pixels that nothing draws are the same in every run
    std::fill_n(color.bytes.data(), kMaxTilePixels * bytes_per_pixel(target.format), std::byte{0});
    return;
  }
  if (target.load == LoadOp::clear) {
    const PacketColor c{Real(target.clear_value.x), Real(target.clear_value.y), Real(target.clear_value.z), Real(target.clear_value.w)};
    write_color(color, 0, Mask(true), c, c, {});
    repeat_first_pixel(color);
    return;
  }
  const ImagePlace place{width, height, held};
  switch (target.format) {
    case ColorFormat::rgba32f: load_planes<float>(target.data, place, tile, color); break;
    case ColorFormat::rgba16f: load_half_planes(target.data, place, tile, color); break;
    default: copy_words<true>(tile, width, height, held, tile.samples, color.bytes.data(), target.data); break;
  }
}

void load_depth(const DepthTarget& target, int width, int height, Samples held, Tile& tile) {
  tile.depth_format = depth_part(target.format);
  tile.has_stencil = has_stencil(target.format);
  if (target.format == DepthFormat::none) return;
  const float clear = depth_value(tile.depth_format, std::clamp(target.clear_value, 0.0f, 1.0f));
  if (target.load != LoadOp::load) {
    tile.depth.fill(clear);
    tile.block_min.fill(clear);
    tile.block_max.fill(clear);
    tile.block_writes.fill(0);
    if (tile.has_stencil) tile.stencil.fill(target.stencil_clear_value);
    return;
  }
  tile.depth.fill(0.0f);  // pixels beyond the target
  if (tile.has_stencil) tile.stencil.fill(0);
  with_codec(target.format, [&]<class C>(C) {
    const auto* image = reinterpret_cast<const typename C::Image*>(target.data);
    for_each_load(tile, {width, height, held}, [&](std::size_t t, std::size_t i) { C::load(image[i], tile.depth[t], tile.stencil[t]); });
  });
  for (int b = 0; b < kBlocks; ++b) refresh_block_bounds(tile, b);
}

namespace {

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

// Sets the tile's pixels in an image to one value.
template <class T>
void fill_rows(T value, std::byte* data, int width, int height, const Tile& tile) {
  alignas(64) std::array<std::byte, 64> line;
  for (std::size_t i = 0; i < 64; i += sizeof(T)) std::memcpy(&line[i], &value, sizeof(T));
  const bool aligned = static_cast<std::size_t>(tile.width) * sizeof(T) % 64 == 0 && static_cast<std::size_t>(tile.x0) * sizeof(T) % 64 == 0;
  const bool stream = aligned && streams(data, width, height, sizeof(T));
  for (int y = 0; y < tile.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(height - 1 - (tile.y0 + y)) * static_cast<std::size_t>(width);
    std::byte* out = data + (row + static_cast<std::size_t>(tile.x0)) * sizeof(T);
    if (stream) {
      stream_lines(line.data(), out, static_cast<std::size_t>(tile.width) * sizeof(T));
    } else {
      std::fill_n(reinterpret_cast<T*>(out), tile.width, value);
    }
  }
  if (stream) _mm_sfence();
}

}  // namespace

void fill_color(const ColorTarget& target, int width, int height, const Tile& tile, const PacketColor& color) {
  if (target.store == StoreOp::dont_care || target.data == nullptr) return;
  ColorBuffer one;
  one.format = target.format;
  write_color(one, 0, Mask(true), color, color, {});
  switch (target.format) {
    case ColorFormat::none: return;
    case ColorFormat::rgba8:
    case ColorFormat::srgb8a8: return fill_rows(*planes<uint32_t>(one), target.data, width, height, tile);
    case ColorFormat::rgba16f: {
      const uint16_t* p = planes<uint16_t>(one);
      return fill_rows(std::array<uint16_t, 4>{p[0], p[kMaxTilePixels], p[2 * kMaxTilePixels], p[3 * kMaxTilePixels]}, target.data, width,
                       height, tile);
    }
    case ColorFormat::rgba32f: {
      const float* p = planes<float>(one);
      return fill_rows(std::array<float, 4>{p[0], p[kMaxTilePixels], p[2 * kMaxTilePixels], p[3 * kMaxTilePixels]}, target.data, width,
                       height, tile);
    }
  }
}

void fill_depth(const DepthTarget& target, int width, int height, const Tile& tile) {
  if (target.store == StoreOp::dont_care || target.data == nullptr) return;
  const float clear = depth_value(depth_part(target.format), std::clamp(target.clear_value, 0.0f, 1.0f));
  with_codec(target.format, [&]<class C>(C) { fill_rows(C::store(clear, target.stencil_clear_value), target.data, width, height, tile); });
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

void refresh_block_bounds(Tile& tile, int block) {
  const float* depth = &tile.depth[static_cast<std::size_t>(block) * kPixelsPerBlock];
  Real low = load<Real>(depth), high = low;
  for (int p = 1; p < kPacketsPerBlock; ++p) {
    const Real z = load<Real>(depth + p * kLanes);
    low = min(low, z);
    high = max(high, z);
  }
  // Minimum and maximum are exact, so their order makes no difference: halves against halves.
  alignas(64) std::array<float, kLanes> lows, highs;
  store(lows.data(), low);
  store(highs.data(), high);
  for (std::size_t half = kLanes / 2; half != 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) {
      lows[i] = min(lows[i], lows[i + half]);
      highs[i] = max(highs[i], highs[i + half]);
    }
  }
  const auto b = static_cast<std::size_t>(block);
  tile.block_min[b] = lows[0];
  tile.block_max[b] = highs[0];
  tile.block_writes[b] = 0;
}

}  // namespace halfspace
