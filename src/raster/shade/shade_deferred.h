// SPDX-License-Identifier: Apache-2.0
//
// Deferred shading: shades each visible pixel of a tile once, after visibility.
#pragma once

#include "halfspace/raster/shade/packed_fragments.h"
#include "halfspace/raster/shade/visible_work.h"

namespace halfspace::HS_LANES {

/// Scratch memory for shade_deferred(). shade_queued() uses the first two members.
struct DeferredShading {
  FragmentOutput output;  ///< not on the stack, because a kernel with many colors needs most of a small stack
  PackedFragments packed;
  ShadingWorkList work;
  std::array<PacketMask, kMaxTilePixels> packets;         ///< the packets of one draw
  std::array<PacketMask, kMaxTilePixels> plane_packets;   ///< those of one sample plane
  std::array<TriangleId, kMaxTilePixels> distinct;        ///< see list_distinct()
  alignas(64) std::array<int32_t, kMaxTilePixels> codes;  ///< shaded colors of multisampled pixels, indexed like `distinct`
};

/// Shades all pixels of the tile that have a triangle in Tile::visibility, which is not changed, and writes their colors. trace: records
/// them, unless it is null.
void shade_deferred(const PassContext& context, Tile& tile, DeferredShading& memory, PassStatistics& statistics, TileTrace* trace);

/// The same for a full-size tile in which all pixels show the same triangle.
void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, DeferredShading& memory, PassStatistics& statistics,
                     TileTrace* trace);

}  // namespace halfspace::HS_LANES
