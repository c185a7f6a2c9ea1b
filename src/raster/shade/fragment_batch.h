// SPDX-License-Identifier: Apache-2.0
//
// Packets for a fragment kernel, each lane with the triangle it shows, and what the kernel returns: linear colours, and for shaders that
// decide them keep masks and depths.
#pragma once

#include <span>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace {

/// Packets that a fragment kernel shades in one call.
inline constexpr int kFragmentBatch = 16;
static_assert(kFragmentBatch % 2 == 0, "two are shaded at a time");

/// Colours, and where the shader decides them keep masks and depths, of a batch.
struct FragmentOutput {
  alignas(64) std::array<PacketColor, kFragmentBatch * kMaxColorTargets> color;  ///< see packet_color()
  alignas(64) std::array<Real, kFragmentBatch> depth;                            ///< if the shader writes depth
  std::array<uint16_t, kFragmentBatch> keep;                                     ///< bit a lane; if the shader discards

  /// The n-th colour of packet i.
  PacketColor& packet_color(std::size_t n, std::size_t i) { return color[n * kFragmentBatch + i]; }
  const PacketColor& packet_color(std::size_t n, std::size_t i) const { return color[n * kFragmentBatch + i]; }
};

struct FragmentBatch {
  const PassContext* context;
  int tile_x0, tile_y0;     ///< window coordinates of pixel (0, 0) of the tile's room
  SamplePosition position;  ///< where in their pixels the shader looks
  const TriangleId* ids;    ///< the tile's triangle of each pixel, or null: uniform_id everywhere
  TriangleId uniform_id;
  const PacketMask* packets;
  int count;                        ///< ≤ kFragmentBatch
  const SamplePosition* centroids;  ///< where centroid varyings are looked up, a row of W for each packet; or null: at position
  FragmentOutput* out;
};

/// The colours of a draw whose shader is constant.
void constant_colors(const Draw& draw, FragmentOutput& out);

/// Writes all colours of a batch, from its packet i on, to packets of the tile.
void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, std::span<const PacketMask> packets, Tile& tile);

}  // namespace halfspace
