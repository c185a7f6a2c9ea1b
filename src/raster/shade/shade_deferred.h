// SPDX-License-Identifier: Apache-2.0
//
// Deferred shading: each visible pixel of a tile once, after visibility.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"

namespace halfspace {

/// One packet's pixels of one draw.
struct ShadingWork {
  const Draw* draw;
  PacketMask packet;
};

/// Working memory of shade_deferred.
struct DeferredShading {
  std::array<ShadingWork, kMaxTilePixels> work;
  std::array<TriangleId, kMaxTilePixels> layer;  ///< one triangle of each pixel that has several samples
  std::array<uint8_t, kMaxTilePixels> taken;     ///< samples that have been in a layer, as bits
};

/// Shades all pixels of the tile that wait for it, and writes their colours.
void shade_deferred(const PassContext& context, Tile& tile, DeferredShading& memory, PassStatistics& statistics);

/// The same where all pixels of the tile's room show one triangle.
void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, PassStatistics& statistics);

}  // namespace halfspace
