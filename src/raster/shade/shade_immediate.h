// SPDX-License-Identifier: Apache-2.0
//
// Immediate shading in submission order, for draws that blend or whose visibility is decided by the fragment function.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"
#include "halfspace/raster/tile/layers.h"

namespace halfspace {

/// Shades the packets of one triangle: runs the remaining tests, and blends and writes colors, or adds them to `layers` for draws with
/// DrawState::order_independent. output: scratch memory. Statistics: as in visibility/visibility.h.
template <class Statistics>
void shade_immediate(const PassContext& context, const Draw& draw, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     TransparentLayers& layers, FragmentOutput& output, Statistics& statistics);

/// The same for all packets of a queue, which become empty. d: the draw of the queue, which is shaded immediately.
template <class Statistics>
void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, Statistics& statistics);

}  // namespace halfspace
