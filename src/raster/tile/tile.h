// SPDX-License-Identifier: Apache-2.0
//
// Tile memory: the pixels of a tile while the pass works on it, and copies from and to images.
//
// Pixels are stored in 8x8 blocks, with Z-order inside each block (bits y2 x2 y1 x1 y0 x0 of the index). Any W consecutive pixels, aligned
// to W, therefore form a compact packet: 4x4 for W = 16, 4x2 for 8, 2x2 for 4. All widths use the same layout.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/target.h"

namespace halfspace::HS_LANES {

inline constexpr int kBlockSize = 8;
inline constexpr int kBlocksPerRow = kMaxTileSize / kBlockSize;
inline constexpr int kBlocks = kBlocksPerRow * kBlocksPerRow;
inline constexpr int kPixelsPerBlock = kBlockSize * kBlockSize;
inline constexpr int kPacketsPerBlock = kPixelsPerBlock / kLanes;
inline constexpr int kPackets = kMaxTilePixels / kLanes;
inline constexpr int kPacketWidth = kLanes >= 8 ? 4 : kLanes >= 4 ? 2 : 1;
inline constexpr int kPacketHeight = kLanes / kPacketWidth;

/// x and y of pixel i in a block, or in a packet if i < W.
constexpr int block_x(int i) { return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4); }
constexpr int block_y(int i) { return (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4); }

/// x and y of the lower left pixel of packet p in the tile.
constexpr int packet_x(int p) {
  const int i = p * kLanes;
  return i / kPixelsPerBlock % kBlocksPerRow * kBlockSize + block_x(i % kPixelsPerBlock);
}
constexpr int packet_y(int p) {
  const int i = p * kLanes;
  return i / kPixelsPerBlock / kBlocksPerRow * kBlockSize + block_y(i % kPixelsPerBlock);
}

/// Position of a packet in the tile.
struct PacketPosition {
  uint8_t x, y;
};
/// packet_x() and packet_y() of each packet. For packets in an unknown order, a lookup is faster than about 14 instructions.
inline constexpr std::array<PacketPosition, kPackets> kPacketPositions = [] {
  std::array<PacketPosition, kPackets> positions{};
  for (int p = 0; p < kPackets; ++p)
    positions[static_cast<std::size_t>(p)] = {static_cast<uint8_t>(packet_x(p)), static_cast<uint8_t>(packet_y(p))};
  return positions;
}();

/// Returns the index of pixel (x, y) in the tile's storage. I is int, or Int for one pixel per lane.
template <class I>
HS_INLINE I pixel_at(I x, I y) {
  const auto spread = [](I i) { return (i & I(1)) | ((i & I(2)) << 1) | ((i & I(4)) << 2); };
  static_assert(kBlockSize == 8 && kBlocksPerRow == 8);
  return (((y >> 3 << 3) | (x >> 3)) << 6) | spread(x) | (spread(y) << 1);
}

/// Returns the distance in packets between sample 0 and the sample that is stored in a sample plane.
constexpr int packet_shift(const SamplePlane& plane) {
  return (plane.y / kBlockSize * kBlocksPerRow + plane.x / kBlockSize) * kPacketsPerBlock;
}

/// Position of each lane's pixel in its packet.
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

/// Some lanes of a packet in the tile.
struct PacketMask {
  uint16_t packet;
  uint16_t lanes;  ///< bit i: lane i
};
/// Lanes of the packets that store the samples of a packet of pixels, for each sample of the tile.
using SampleLanes = std::array<uint16_t, kMaxSamples>;

/// Colors of a packet: r, g, b and a, with one value per lane.
using PacketColor = std::array<Real, 4>;

/// Color buffer of a tile, in the format of the attachment. 8-bit formats use one uint32 per pixel, with r in the lowest byte. All other
/// formats use a plane for each channel.
struct ColorBuffer {
  ColorFormat format = ColorFormat::none;
  alignas(64) std::array<std::byte, kMaxTilePixels * 16> bytes;
};

/// The tile that a task works on. With one attachment of 8-bit channels, about 52 KB of it are used; with
/// rgba32f, about 100 KB. In a multisampled tile, all arrays are divided into one
/// sample plane per sample (see raster/pipeline/sample_pattern.h).
struct Tile {
  int x0 = 0, y0 = 0;         ///< window coordinates of the lower left pixel
  int width = 0, height = 0;  ///< pixels inside the target
  int size = kMaxTileSize;
  int samples = 1;
  DepthFormat depth_format = DepthFormat::none;  ///< without stencil
  bool has_stencil = false;

  /// Depth as represented by the format: the depth itself for d32f, the integer value for d16 and d24 (exact in float).
  alignas(64) std::array<float, kMaxTilePixels> depth;
  /// For pixels that are not shaded yet: the visible triangle. Otherwise kNoTriangle. Undefined while all pixels are shaded.
  alignas(64) std::array<TriangleId, kMaxTilePixels> visibility;
  alignas(64) std::array<uint8_t, kMaxTilePixels> stencil;
  std::array<ColorBuffer, kMaxColorTargets> color;
  int color_count = 0;

  /// Bounds of the depth in each block (hierarchical Z). They may be wider than necessary, but never too narrow.
  std::array<float, kBlocks> hiz_min, hiz_max;
  /// Depth was written to the block since its bounds were last exact.
  std::array<bool, kBlocks> hiz_is_stale;
};

// Copies between a tile and an image. If the image has one value per pixel, it is loaded into all samples, and stored from sample 0. These
// and the fill functions may write with streaming stores; see finish_stores().
void load_color(const ColorTarget& target, const Tile& tile, ColorBuffer& color);
void load_depth(const DepthTarget& target, Tile& tile);
void store_color(const ColorTarget& target, const Tile& tile, const ColorBuffer& color);
void store_depth(const DepthTarget& target, const Tile& tile);

/// Fills pixels of an image with a color, or with the clear depth and stencil of the target. All samples of the image are filled.
void fill_color(const ColorTarget& target, const PixelBounds& pixels, const PacketColor& color);
void fill_depth(const DepthTarget& target, const PixelBounds& pixels);

/// Makes all preceding streaming stores of this thread visible to other threads. A task must call it before it ends. Calling it after each
/// tile would delay the next tile until the stores have reached the memory.
inline void finish_stores() { _mm_sfence(); }

/// Recomputes the exact depth bounds of a block.
void refresh_hiz(Tile& tile, int block);

}  // namespace halfspace::HS_LANES
