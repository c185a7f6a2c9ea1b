// SPDX-License-Identifier: Apache-2.0
//
// Visibility of queued draws whose visibility function decides which pixels are drawn, or replaces their depth.
#pragma once

#include "halfspace/raster/visibility/sink/packet_queue.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Runs the visibility function for all packets of a queue, tests and writes them, and empties the queue. d: the draw of the queue, with
/// shades_later(d.mode).
void decide_queued(const DrawInTile& d, PacketQueue& queue, PassStatistics& statistics);

}  // namespace halfspace::HS_LANES
