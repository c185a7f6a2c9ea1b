// SPDX-License-Identifier: Apache-2.0
//
// Mapping between the pixels of a tile and the pixels of an image.
#pragma once

#include <algorithm>
#include <cstring>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

constexpr std::array<uint8_t, kPixelsPerBlock> make_z_order() {
  std::array<uint8_t, kPixelsPerBlock> place{};
  for (int i = 0; i < kPixelsPerBlock; ++i) place[static_cast<std::size_t>(block_y(i) * kBlockSize + block_x(i))] = static_cast<uint8_t>(i);
  return place;
}
// Index of pixel (x, y) in a block: kZOrder[8·y + x].
inline constexpr std::array<uint8_t, kPixelsPerBlock> kZOrder = make_z_order();

// Calls f(first, out, count) for each row of each block, clipped to the target, and for each sample. `count` is the number of pixels in the
// row. Pixel i of the row has the index first + kZOrder[i] in the tile, and out is the address of the first one in the image, which has
// `bytes` bytes per pixel. Image: see target_texels(). If it has one layer, all samples use that.
template <class F>
HS_INLINE void for_each_row(const Tile& tile, const TexelView& image, std::size_t bytes, int samples, F f) {
  const std::ptrdiff_t row_pitch = image.row_pitch, layer_pitch = image.layers == 1 ? 0 : image.layer_pitch;
  for (int s = 0; s < samples; ++s) {
    const SamplePlane plane = sample_plane(tile.samples, s, tile.size);
    const std::size_t shift = static_cast<std::size_t>(packet_shift(plane)) * kLanes;
    std::byte* out = image.data + s * layer_pitch + tile.y0 * row_pitch + static_cast<std::size_t>(tile.x0) * bytes;
    for (int y = 0; y < tile.height; ++y, out += row_pitch) {
      for (int x = 0; x < tile.width; x += kBlockSize) {
        const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
        f(shift + block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize)], out + static_cast<std::size_t>(x) * bytes,
          std::min(kBlockSize, tile.width - x));
      }
    }
  }
}

// Calls f(pixel of the tile, address of the pixel of the image) for each pixel.
template <class F>
HS_INLINE void for_each_pixel(const Tile& tile, const TexelView& image, std::size_t bytes, int samples, F f) {
  for_each_row(tile, image, bytes, samples, [&](std::size_t first, std::byte* out, int pixels) {
    if (pixels == kBlockSize) {  // offsets are compile-time constants
      for (std::size_t i = 0; i < kBlockSize; ++i) f(first + kZOrder[i], out + i * bytes);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) f(first + kZOrder[i], out + i * bytes);
    }
  });
}

// The same as for_each_pixel() for images with 32 bits per pixel. Copies two horizontal neighbors at a time, which are adjacent in both
// tile and image. load: copy from the image to the tile, otherwise from the tile to the image.
template <bool load, class TileBytes>
void copy_words(const Tile& tile, const TexelView& image, int samples, TileBytes* in_tile) {
  const auto copy = [&]<std::size_t bytes>(std::integral_constant<std::size_t, bytes>, std::size_t t, std::byte* pixel) {
    if constexpr (load) {
      std::memcpy(in_tile + 4 * t, pixel, bytes);
    } else {
      std::memcpy(pixel, in_tile + 4 * t, bytes);
    }
  };
  for_each_row(tile, image, 4, samples, [&](std::size_t first, std::byte* out, int pixels) {
    if (pixels == kBlockSize) {
      for (std::size_t i = 0; i < kBlockSize; i += 2) copy(std::integral_constant<std::size_t, 8>(), first + kZOrder[i], out + 4 * i);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) {
        copy(std::integral_constant<std::size_t, 4>(), first + kZOrder[i], out + 4 * i);
      }
    }
  });
}

// Images of at least this size do not fit in the L2 cache. They are written with streaming stores, which bypass the cache and do not read
// each line first.
inline constexpr std::size_t kStreamBytes = std::size_t{4} << 20;

// Returns true if a layer of the image is large and suitably aligned for streaming stores.
inline bool streams(const TexelView& image, std::size_t bytes) {
  const std::size_t row = static_cast<std::size_t>(image.width) * bytes;
  return row * static_cast<std::size_t>(image.height) >= kStreamBytes && image.row_pitch % 64 == 0 &&
         reinterpret_cast<uintptr_t>(image.data) % 64 == 0;
}

// Splits the tile into groups two rows high and `columns` (2 or 4) pixels wide, which are one or two 2x2 quads, and calls f(t, row0, row1)
// for each group. The pixels of a group are contiguous in the tile, one quad after the other, starting at index t. In the image, which has
// four channels of 16 bits, the lower and upper row of the group start at the addresses row0 and row1. Returns false and does nothing if
// the tile is multisampled or contains incomplete groups.
template <int columns, class F>
HS_INLINE bool for_each_two_rows(const Tile& tile, const TexelView& image, F f) {
  constexpr std::size_t kBytes = 8;
  if (tile.samples != 1 || tile.width % columns != 0 || tile.height % 2 != 0) return false;
  const std::ptrdiff_t pitch = image.row_pitch;
  std::byte* row = image.data + tile.y0 * pitch + static_cast<std::size_t>(tile.x0) * kBytes;
  for (int y = 0; y < tile.height; y += 2, row += 2 * pitch) {
    for (int x = 0; x < tile.width; x += columns) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::size_t in_tile = block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize + x % kBlockSize)];
      std::byte* const row0 = row + static_cast<std::size_t>(x) * kBytes;
      f(in_tile, row0, row0 + pitch);
    }
  }
  return true;
}

}  // namespace halfspace::HS_LANES
