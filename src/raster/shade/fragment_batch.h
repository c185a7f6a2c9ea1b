// SPDX-License-Identifier: Apache-2.0
//
// Input and output of fragment kernels. Input: packets of pixels, with a triangle for each lane. Output: linear colors, plus keep masks and
// depths if the shader returns them.
#pragma once

#include <span>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/tile/write_programs.h"
#include "halfspace/raster/visibility/sink/packet_batch.h"

namespace halfspace::HS_LANES {

struct Draw;
struct ShaderKernels;

/// Batch colors, plus the keep masks and depths if the shader returns them.
struct FragmentOutput {
  // Each array has one element more than a batch can fill, because unpack() reads past the last pixel.
  alignas(64) std::array<PacketColor, kPacketBatch * kMaxColorTargets + 1> color;  ///< see packet_color()
  alignas(64) std::array<Real, kPacketBatch + 1> depth;                            ///< if the shader writes depth
  std::array<uint16_t, kPacketBatch + 1> keep;                                     ///< one bit per lane; if the shader discards
  alignas(64) std::array<Int, kPacketBatch + 1> sample_mask;                       ///< if the shader returns it; not of packed pixels

  /// Returns color n of packet i.
  PacketColor& packet_color(std::size_t n, std::size_t i) { return color[n * kPacketBatch + i]; }
  const PacketColor& packet_color(std::size_t n, std::size_t i) const { return color[n * kPacketBatch + i]; }
  /// Returns component c of color n of all packets. Batches with `pixels` store the memory of the colors in this order.
  float* color_plane(std::size_t n, std::size_t c) { return reinterpret_cast<float*>(color.data()) + plane_offset(n, c); }
  const float* color_plane(std::size_t n, std::size_t c) const { return reinterpret_cast<const float*>(color.data()) + plane_offset(n, c); }

 private:
  static std::size_t plane_offset(std::size_t n, std::size_t c) { return (n * 4 + c) * std::size_t{kPacketBatch * kLanes}; }
};

/// Packets for a fragment kernel. If `pixels` is set, colors are stored as color_plane().
struct FragmentBatch : PacketBatch {
  FragmentOutput* out;
  /// If not null, the kernel encodes the first color of each packet as rgba8 and writes it here; there is no other output. Indexed like the
  /// pixels of the tile's storage, or of a packed batch. Only for ShaderKernels::color.
  int32_t* codes = nullptr;
  /// If it has a program, the kernel writes the color of each packet to the buffer, in the order of the packets; there is no other output.
  /// Only for kernels that do not return keep masks and depths, and for the first color of a shader.
  WriteTarget target = {};
};

/// Computes the colors of a draw with a constant shader and stores them as packet 0 of out.
void constant_colors(const Draw& draw, FragmentOutput& out);

/// Writes the colors in out to the tile. packets[k] receives all colors of packet i + k of the batch.
void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile);

}  // namespace halfspace::HS_LANES
