// SPDX-License-Identifier: Apache-2.0
//
// Immediate shading in submission order, for draws that blend or whose fragment function decides visibility.
#pragma once

#include "halfspace/raster/shade/packed_fragments.h"
#include "halfspace/raster/tile/layers.h"

namespace halfspace::HS_LANES {

/// Shades the packets of one triangle: runs the remaining tests, and blends and writes colors, or adds them to `layers` for draws with
/// DrawState::order_independent. output: scratch memory. Statistics: see visibility/visibility.h.
template <class Statistics>
void shade_immediate(const PassContext& context, const Draw& draw, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     TransparentLayers& layers, FragmentOutput& output, Statistics& statistics);

/// The same for all packets of a queue, which is empty afterwards. d: the draw of the queue, which must be shaded immediately. packed:
/// scratch memory.
template <class Statistics>
void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, PackedFragments& packed,
                  Statistics& statistics);

}  // namespace halfspace::HS_LANES
