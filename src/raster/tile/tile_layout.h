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
// row. Pixel i of the row has the index first + kZOrder[i] in the tile and the index out + i in the image. With ImageSamples::one, all
// samples use the same pixels of the image.
template <class F>
HS_INLINE void for_each_row(const Tile& tile, int target_width, int target_height, ImageSamples stored, int samples, F f) {
  for (int s = 0; s < samples; ++s) {
    const SamplePlane plane = sample_plane(tile.samples, s, tile.size);
    const std::size_t shift = static_cast<std::size_t>(packet_shift(plane)) * kLanes;
    const std::size_t image = stored == ImageSamples::one ? 0 : static_cast<std::size_t>(s) * static_cast<std::size_t>(target_height);
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

// Calls f(pixel of the tile, pixel of the image) for each pixel.
template <class F>
HS_INLINE void for_each_pixel(const Tile& tile, int target_width, int target_height, ImageSamples stored, int samples, F f) {
  for_each_row(tile, target_width, target_height, stored, samples, [&](std::size_t first, std::size_t out, int pixels) {
    if (pixels == kBlockSize) {  // offsets are compile-time constants
      for (std::size_t i = 0; i < kBlockSize; ++i) f(first + kZOrder[i], out + i);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) f(first + kZOrder[i], out + i);
    }
  });
}

// The same as for_each_pixel() for images with 32 bits per pixel. Copies two horizontal neighbors at a time, which are adjacent in both
// tile and image. load: copy from the image to the tile, otherwise from the tile to the image.
template <bool load, class TileBytes, class ImageBytes>
void copy_words(const Tile& tile, int target_width, int target_height, ImageSamples stored, int samples, TileBytes* in_tile,
                ImageBytes* in_image) {
  const auto copy = [&]<std::size_t bytes>(std::integral_constant<std::size_t, bytes>, std::size_t t, std::size_t i) {
    if constexpr (load) {
      std::memcpy(in_tile + 4 * t, in_image + 4 * i, bytes);
    } else {
      std::memcpy(in_image + 4 * i, in_tile + 4 * t, bytes);
    }
  };
  for_each_row(tile, target_width, target_height, stored, samples, [&](std::size_t first, std::size_t out, int pixels) {
    if (pixels == kBlockSize) {
      for (std::size_t i = 0; i < kBlockSize; i += 2) copy(std::integral_constant<std::size_t, 8>(), first + kZOrder[i], out + i);
    } else {
      for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i) {
        copy(std::integral_constant<std::size_t, 4>(), first + kZOrder[i], out + i);
      }
    }
  });
}

// Layout of an image that a tile is loaded from or stored to.
struct ImageLayout {
  int width, height;
  ImageSamples stored;
};

// Images of at least this size do not fit in the L2 cache. They are written with streaming stores, which bypass the cache and do not read
// each line first.
inline constexpr std::size_t kStreamBytes = std::size_t{4} << 20;

// Returns true if the image is large and suitably aligned for streaming stores.
inline bool streams(const std::byte* data, int width, int height, int bytes) {
  const auto row = static_cast<std::size_t>(width) * static_cast<std::size_t>(bytes);
  return row * static_cast<std::size_t>(height) >= kStreamBytes && row % 64 == 0 && reinterpret_cast<uintptr_t>(data) % 64 == 0;
}

// Splits the tile into groups two rows high and `columns` (2 or 4) pixels wide, which are one or two 2x2 quads, and calls f(t, i0, i1) for
// each group. The pixels of a group are contiguous in the tile, one quad after the other, starting at index t. In the image, the lower and
// upper row of the group start at the offsets i0 and i1, in channels (four per pixel). Returns false and does nothing if the tile is
// multisampled or contains incomplete groups.
template <int columns, class F>
HS_INLINE bool for_each_two_rows(const Tile& tile, const ImageLayout& place, F f) {
  if (tile.samples != 1 || tile.width % columns != 0 || tile.height % 2 != 0) return false;
  for (int y = 0; y < tile.height; y += 2) {
    const std::size_t row = static_cast<std::size_t>(place.height - 1 - (tile.y0 + y)) * static_cast<std::size_t>(place.width);
    for (int x = 0; x < tile.width; x += columns) {
      const std::size_t block = static_cast<std::size_t>(y / kBlockSize * kBlocksPerRow + x / kBlockSize) * kPixelsPerBlock;
      const std::size_t in_tile = block + kZOrder[static_cast<std::size_t>(y % kBlockSize * kBlockSize + x % kBlockSize)];
      const std::size_t in_image = row + static_cast<std::size_t>(tile.x0 + x);
      f(in_tile, 4 * in_image, 4 * (in_image - static_cast<std::size_t>(place.width)));
    }
  }
  return true;
}

}  // namespace halfspace::HS_LANES
