// SPDX-License-Identifier: Apache-2.0
//
// Shading in submission order, for draws that blend or whose fragment function decides visibility. Input: the packets of a queue. Output:
// the colors, depths and stencil values of the tile, or transparent layers.
#pragma once

#include "halfspace/raster/shade/packed_fragments.h"
#include "halfspace/raster/tile/layers.h"
#include "halfspace/raster/visibility/sink/packet_queue.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Shades all packets of a queue, which is empty afterwards: runs the remaining tests, and blends and writes colors, or adds them to
/// `layers` for draws with DrawState::order_independent. d: the draw of the queue, with a mode other than those of shades_later(). output,
/// packed: scratch memory.
void shade_queued(const DrawInTile& d, PacketQueue& queue, TransparentLayers& layers, FragmentOutput& output, PackedFragments& packed,
                  PassStatistics& statistics);

}  // namespace halfspace::HS_LANES
