// SPDX-License-Identifier: Apache-2.0
//
// Input and output of fragment kernels. Input: packets of pixels, with a triangle for each lane. Output: linear colors, plus keep masks and
// depths if the shader returns them.
#pragma once

#include <span>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace {

/// Maximum number of packets per call of a fragment kernel.
inline constexpr int kFragmentBatch = 16;
static_assert(kFragmentBatch % 2 == 0, "packets are shaded in pairs");

/// Colors of a batch, and keep masks and depths if the shader returns them.
struct FragmentOutput {
  alignas(64) std::array<PacketColor, kFragmentBatch * kMaxColorTargets> color;  ///< see packet_color()
  alignas(64) std::array<Real, kFragmentBatch> depth;                            ///< if the shader writes depth
  std::array<uint16_t, kFragmentBatch> keep;                                     ///< one bit per lane; if the shader discards

  /// Returns color n of packet i.
  PacketColor& packet_color(std::size_t n, std::size_t i) { return color[n * kFragmentBatch + i]; }
  const PacketColor& packet_color(std::size_t n, std::size_t i) const { return color[n * kFragmentBatch + i]; }
};

/// Packets for a fragment kernel.
struct FragmentBatch {
  const PassContext* context;
  int tile_x0, tile_y0;          ///< window coordinates of pixel (0, 0) of the tile's storage
  SamplePosition position;       ///< position within the pixel at which the shader is evaluated
  const TriangleId* ids;         ///< triangle of each pixel of the tile; null if each packet shows only one, see packet_ids
  const TriangleId* packet_ids;  ///< triangle of each packet; only used if ids is null
  const PacketMask* packets;
  int count;                        ///< ≤ kFragmentBatch, unless `codes` is set
  const SamplePosition* centroids;  ///< positions of centroid varyings, W for each packet; null if the same as position
  FragmentOutput* out;
  /// If not null, the kernel encodes the first color of each packet as rgba8 and writes it here, indexed like the pixels of the tile's
  /// storage; there is no other output. Only for ShaderKernels::color.
  int32_t* codes = nullptr;
};

/// Computes the colors of a draw with a constant shader and stores them as packet 0 of out.
void constant_colors(const Draw& draw, FragmentOutput& out);

/// Writes the colors in out to the tile. packets[k] receives all colors of packet i + k of the batch.
void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile);

}  // namespace halfspace
