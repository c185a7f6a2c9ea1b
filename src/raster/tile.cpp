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

// Calls f(pixel of the tile, pixel of the image) for every pixel of the tile inside the target, row by row, and so for
// every sample; images of one sample give and take the first one's.
template <class F>
HS_INLINE void for_each_pixel(const Tile& tile, int target_width, int target_height, Samples held, int samples, F f) {
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
        const std::size_t first = shift + block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)];
        if (tile.width - x >= kBlockSize) {  // a whole row of the block: places known when compiling
          for (std::size_t i = 0; i < kBlockSize; ++i) f(first + kZOrder[i], out + static_cast<std::size_t>(x) + i);
        } else {
          for (int i = 0; i < tile.width - x; ++i) f(first + kZOrder[static_cast<std::size_t>(i)], out + static_cast<std::size_t>(x + i));
        }
      }
    }
  }
}

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
  for_each_pixel(tile, p.width, p.height, p.held, p.held == Samples::one ? 1 : tile.samples, f);
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
    case ColorFormat::rgba16f: load_planes<uint16_t>(target.data, place, tile, color); break;
    default: {
      const auto* image = reinterpret_cast<const uint32_t*>(target.data);
      uint32_t* to = planes<uint32_t>(color);
      for_each_load(tile, place, [&](std::size_t t, std::size_t i) { to[t] = image[i]; });
    }
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

void store_color(const ColorTarget& target, int width, int height, Samples held, const Tile& tile, const ColorBuffer& color) {
  if (target.format == ColorFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  const ImagePlace place{width, height, held};
  switch (target.format) {
    case ColorFormat::rgba32f: store_planes<float>(target.data, place, tile, color); break;
    case ColorFormat::rgba16f: store_planes<uint16_t>(target.data, place, tile, color); break;
    default: {
      auto* image = reinterpret_cast<uint32_t*>(target.data);
      const uint32_t* from = planes<uint32_t>(color);
      for_each_store(tile, place, [&](std::size_t t, std::size_t i) { image[i] = from[t]; });
    }
  }
}

void store_depth(const DepthTarget& target, int width, int height, Samples held, const Tile& tile) {
  if (target.format == DepthFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
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
  // Minimum and maximum are exact, so their order makes no difference.
  float block_min = lane(low, 0), block_max = lane(high, 0);
  for (int i = 1; i < kLanes; ++i) {
    block_min = min(block_min, lane(low, i));
    block_max = max(block_max, lane(high, i));
  }
  const auto b = static_cast<std::size_t>(block);
  tile.block_min[b] = block_min;
  tile.block_max[b] = block_max;
  tile.block_writes[b] = 0;
}

}  // namespace halfspace
