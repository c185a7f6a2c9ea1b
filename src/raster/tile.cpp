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

// Calls f(pixel of the tile, pixel of the image) for every pixel of the tile inside the target, row by row.
template <class F>
HS_INLINE void for_each_pixel(const Tile& tile, int target_width, int target_height, F f) {
  for (int y = 0; y < tile.height; ++y) {
    const auto row = static_cast<std::size_t>(target_height - 1 - (tile.y0 + y)) * static_cast<std::size_t>(target_width);
    const std::size_t out = row + static_cast<std::size_t>(tile.x0);
    for (int x = 0; x < tile.width; x += kBlockSize) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::size_t first = block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)];
      if (tile.width - x >= kBlockSize) {  // a whole row of the block: places known when compiling
        for (std::size_t i = 0; i < kBlockSize; ++i) f(first + kZOrder[i], out + static_cast<std::size_t>(x) + i);
      } else {
        for (int i = 0; i < tile.width - x; ++i) f(first + kZOrder[static_cast<std::size_t>(i)], out + static_cast<std::size_t>(x + i));
      }
    }
  }
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
void load_planes(const ColorTarget& target, int width, int height, Tile& tile) {
  const T* image = reinterpret_cast<const T*>(target.data);
  T* to = planes<T>(tile.color);
  for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) to[k * kMaxTilePixels + t] = image[4 * i + k];
  });
}

template <class T>
void store_planes(const ColorTarget& target, int width, int height, const Tile& tile, const ColorBuffer& color) {
  T* image = reinterpret_cast<T*>(target.data);
  const T* from = planes<T>(color);
  for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) {
    for (std::size_t k = 0; k < 4; ++k) image[4 * i + k] = from[k * kMaxTilePixels + t];
  });
}

template <class T>
void load_depth_codes(const DepthTarget& target, int width, int height, Tile& tile) {
  const T* image = reinterpret_cast<const T*>(target.data);
  for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) { tile.depth[t] = static_cast<float>(image[i]); });
}

template <class T>
void store_depth_codes(const DepthTarget& target, int width, int height, const Tile& tile) {
  T* image = reinterpret_cast<T*>(target.data);
  for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) { image[i] = static_cast<T>(tile.depth[t]); });
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

void load_color(const ColorTarget& target, int width, int height, Tile& tile) {
  tile.color.format = target.format;
  if (target.format == ColorFormat::none) return;
  if (target.load == LoadOp::dont_care) {  // zeros, so that even pixels that nothing draws are the same in every run
    std::fill_n(tile.color.bytes.data(), kMaxTilePixels * bytes_per_pixel(target.format), std::byte{0});
    return;
  }
  if (target.load == LoadOp::clear) {
    const PacketColor c{Real(target.clear_value.x), Real(target.clear_value.y), Real(target.clear_value.z), Real(target.clear_value.w)};
    write_color(tile.color, 0, Mask(true), c, nullptr);
    repeat_first_pixel(tile.color);
    return;
  }
  switch (target.format) {
    case ColorFormat::rgba32f: load_planes<float>(target, width, height, tile); break;
    case ColorFormat::rgba16f: load_planes<uint16_t>(target, width, height, tile); break;
    default: {
      const auto* image = reinterpret_cast<const uint32_t*>(target.data);
      uint32_t* to = planes<uint32_t>(tile.color);
      for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) { to[t] = image[i]; });
    }
  }
}

void load_depth(const DepthTarget& target, int width, int height, Tile& tile) {
  tile.depth_format = target.format;
  if (target.format == DepthFormat::none) return;
  const float clear = depth_value(target.format, std::clamp(target.clear_value, 0.0f, 1.0f));
  if (target.load != LoadOp::load) {
    tile.depth.fill(clear);
    tile.block_min.fill(clear);
    tile.block_max.fill(clear);
    tile.block_writes.fill(0);
    return;
  }
  tile.depth.fill(0.0f);  // pixels beyond the target
  switch (target.format) {
    case DepthFormat::d16: load_depth_codes<uint16_t>(target, width, height, tile); break;
    case DepthFormat::d24: load_depth_codes<uint32_t>(target, width, height, tile); break;
    default: load_depth_codes<float>(target, width, height, tile); break;
  }
  for (int b = 0; b < kBlocks; ++b) refresh_block_bounds(tile, b);
}

void store_color(const ColorTarget& target, int width, int height, const Tile& tile, const ColorBuffer& color) {
  if (target.format == ColorFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  switch (target.format) {
    case ColorFormat::rgba32f: store_planes<float>(target, width, height, tile, color); break;
    case ColorFormat::rgba16f: store_planes<uint16_t>(target, width, height, tile, color); break;
    default: {
      auto* image = reinterpret_cast<uint32_t*>(target.data);
      const uint32_t* from = planes<uint32_t>(color);
      for_each_pixel(tile, width, height, [&](std::size_t t, std::size_t i) { image[i] = from[t]; });
    }
  }
}

void store_depth(const DepthTarget& target, int width, int height, const Tile& tile) {
  if (target.format == DepthFormat::none || target.store == StoreOp::dont_care || target.data == nullptr) return;
  switch (target.format) {
    case DepthFormat::d16: store_depth_codes<uint16_t>(target, width, height, tile); break;
    case DepthFormat::d24: store_depth_codes<uint32_t>(target, width, height, tile); break;
    default: store_depth_codes<float>(target, width, height, tile); break;
  }
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
