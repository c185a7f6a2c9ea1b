// SPDX-License-Identifier: Apache-2.0
//
// Deferred shading: shades each visible pixel of a tile once, after visibility.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"

namespace halfspace {

/// Pixels of a packet that show the same draw.
struct ShadingWork {
  const Draw* draw;
  PacketMask packet;
};

/// Scratch memory for shade_deferred().
struct DeferredShading {
  FragmentOutput output;  ///< not on the stack, because a kernel with many colors needs most of a small stack
  std::array<ShadingWork, kMaxTilePixels> work;
  std::array<PacketMask, kMaxTilePixels> packets;  ///< the packets of `work`
  std::array<TriangleId, kMaxTilePixels> layer;    ///< one triangle of each multisampled pixel
  /// Lanes of the samples of each packet whose triangle has been in a layer, or that show none.
  std::array<std::array<uint16_t, kMaxSamples>, kPackets> taken;
};

/// Shades all pixels of the tile that have a visible triangle but no color yet, and writes their colors. Statistics: see
/// visibility/visibility.h.
template <class Statistics>
void shade_deferred(const PassContext& context, Tile& tile, DeferredShading& memory, Statistics& statistics);

/// The same for a full-size tile in which all pixels show one triangle.
template <class Statistics>
void shade_full_tile(const PassContext& context, TriangleId id, Tile& tile, DeferredShading& memory, Statistics& statistics);

}  // namespace halfspace
