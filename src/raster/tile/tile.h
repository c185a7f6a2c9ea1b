// SPDX-License-Identifier: Apache-2.0
//
// Tile memory: the pixels of one tile while the pass works on it, and its way from and to the images.
//
// Pixels lie in 8x8 blocks, and in a block in Z order (bits y2 x2 y1 x1 y0 x0 of the index). So every run of W
// consecutive pixels is a compact packet: 4x4 at W = 16, 4x2 at 8, 2x2 at 4, and one layout serves all widths.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/target.h"

namespace halfspace {

inline constexpr int kBlockSize = 8;
inline constexpr int kBlocksPerRow = kMaxTileSize / kBlockSize;
inline constexpr int kBlocks = kBlocksPerRow * kBlocksPerRow;
inline constexpr int kPixelsPerBlock = kBlockSize * kBlockSize;
inline constexpr int kPacketsPerBlock = kPixelsPerBlock / kLanes;
inline constexpr int kPackets = kMaxTilePixels / kLanes;
inline constexpr int kPacketWidth = kLanes >= 8 ? 4 : kLanes >= 4 ? 2 : 1;
inline constexpr int kPacketHeight = kLanes / kPacketWidth;

/// x and y of pixel i of a block (or of a packet: i < W).
constexpr int block_x(int i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }
constexpr int block_y(int i) { return (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4); }

/// x and y in the tile of packet p's lowest corner.
constexpr int packet_x(int p) {
  const int i = p * kLanes;
  return i / kPixelsPerBlock % kBlocksPerRow * kBlockSize + block_x(i % kPixelsPerBlock);
}
constexpr int packet_y(int p) {
  const int i = p * kLanes;
  return i / kPixelsPerBlock / kBlocksPerRow * kBlockSize + block_y(i % kPixelsPerBlock);
}

/// Where pixel (x, y) of the tile lies in it. Of one, or lane by lane.
template <class I>
HS_INLINE I pixel_at(I x, I y) {
  const auto spread = [](I i) { return (i & I(1)) | ((i & I(2)) << 1) | ((i & I(4)) << 2); };
  static_assert(kBlockSize == 8 && kBlocksPerRow == 8);
  return (((y >> 3 << 3) | (x >> 3)) << 6) | spread(x) | (spread(y) << 1);
}

/// How many packets after that of sample 0 the packet of another sample's cell lies.
constexpr int packet_shift(const SamplePlane& plane) {
  return (plane.y / kBlockSize * kBlocksPerRow + plane.x / kBlockSize) * kPacketsPerBlock;
}

/// The lanes' places in their packet.
HS_INLINE Int lane_x() {
  Int r{};
  for (int i = 0; i < kLanes; ++i) set_lane(r, i, block_x(i));
  return r;
}
HS_INLINE Int lane_y() {
  Int r{};
  for (int i = 0; i < kLanes; ++i) set_lane(r, i, block_y(i));
  return r;
}

/// Some lanes of one packet of a tile.
struct PacketMask {
  uint16_t packet;
  uint16_t lanes;  ///< bit i: lane i
};

/// Four rows of W floats: r, g, b, a of a packet.
using PacketColor = std::array<Real, 4>;

/// The colours of a tile, in a target's format: 8-bit formats as one uint32 a pixel (r lowest); rgba16f and rgba32f as
/// four planes.
struct ColorBuffer {
  ColorFormat format = ColorFormat::none;
  alignas(64) std::array<std::byte, kMaxTilePixels * 16> bytes;
};

/// The pixels of the tile that a task works on. With one attachment some 100 KB of it are used.
/// With several samples a pixel all arrays hold one cell a sample (see raster/pipeline/sample_pattern.h).
struct Tile {
  int x0 = 0, y0 = 0;         ///< window coordinates of its lower left pixel
  int width = 0, height = 0;  ///< pixels inside the target
  int size = kMaxTileSize;
  int samples = 1;
  DepthFormat depth_format = DepthFormat::none;  ///< without its stencil
  bool has_stencil = false;

  /// Depth values as the format holds them: d32f the depth itself, d16 and d24 the code (a whole number; exact in float).
  alignas(64) std::array<float, kMaxTilePixels> depth;
  /// The visible triangle of each pixel not shaded yet, or kNoTriangle.
  alignas(64) std::array<TriangleId, kMaxTilePixels> visibility;
  alignas(64) std::array<uint8_t, kMaxTilePixels> stencil;
  std::array<ColorBuffer, kMaxColorTargets> color;
  int color_count = 0;

  /// Bounds of the depth values in each block: never narrower than the values.
  std::array<float, kBlocks> hiz_min, hiz_max;
  /// Writes since the bounds were last exact.
  std::array<uint8_t, kBlocks> hiz_writes;
};

/// What an image holds of pixels with several samples.
enum class ImageSamples : uint8_t {
  one,  ///< one value a pixel: loaded into all samples, stored from sample 0
  all   ///< an image for each sample, one after the other
};

// Between tile and image. Images hold the top row first, tiles the bottom row: rows are turned round here.
void load_color(const ColorTarget& target, int target_width, int target_height, ImageSamples stored, const Tile& tile, ColorBuffer& color);
void load_depth(const DepthTarget& target, int target_width, int target_height, ImageSamples stored, Tile& tile);
void store_color(const ColorTarget& target, int target_width, int target_height, ImageSamples stored, const Tile& tile,
                 const ColorBuffer& color);
void store_depth(const DepthTarget& target, int target_width, int target_height, ImageSamples stored, const Tile& tile);

/// Sets pixels of an image: to a colour, and to the depth and stencil that the target is cleared to.
void fill_color(const ColorTarget& target, int target_width, int target_height, const PixelBounds& pixels, const PacketColor& color);
void fill_depth(const DepthTarget& target, int target_width, int target_height, const PixelBounds& pixels);

/// Makes a block's depth bounds exact.
void refresh_hiz(Tile& tile, int block);

}  // namespace halfspace
