// SPDX-License-Identifier: Apache-2.0
//
// The writer of each path: what happens with the covered packets that a loop over triangles finds.
#pragma once

#include "halfspace/raster/visibility/opaque_writer.h"
#include "halfspace/raster/visibility/stencil_queue_writer.h"
#include "halfspace/raster/visibility/stencil_writer.h"

namespace halfspace::HS_LANES {

/// Returns the writer of a path. multisampled: for multisampled tiles. The arguments must outlive it.
template <TilePath path, bool multisampled, class Statistics>
HS_INLINE auto path_writer(const DrawInTile& d, [[maybe_unused]] PacketQueue& queue, Statistics& statistics) {
  if constexpr (path == TilePath::nearest) return OpaqueWriter<Statistics, true>(d, statistics);
  if constexpr (path == TilePath::opaque) return OpaqueWriter<Statistics>(d, statistics);
  if constexpr (path == TilePath::stencil) return StencilWriter<Statistics>(d, statistics);
  if constexpr (path == TilePath::queued) return QueueWriter<Statistics, multisampled>(d, queue, statistics);
  if constexpr (path == TilePath::queued_less) return QueueWriter<Statistics, multisampled, !multisampled>(d, queue, statistics);
  if constexpr (path == TilePath::queued_stencil) return StencilQueueWriter<Statistics, multisampled>(d, queue, statistics);
}

/// Calls f.template operator()<path>() for a path that is known at run time, and returns the result.
template <class F>
auto with_path(TilePath path, const F& f) {
  switch (path) {
    case TilePath::nearest: return f.template operator()<TilePath::nearest>();
    case TilePath::opaque: return f.template operator()<TilePath::opaque>();
    case TilePath::stencil: return f.template operator()<TilePath::stencil>();
    case TilePath::queued: return f.template operator()<TilePath::queued>();
    case TilePath::queued_less: return f.template operator()<TilePath::queued_less>();
    case TilePath::queued_stencil: break;
  }
  return f.template operator()<TilePath::queued_stencil>();
}

}  // namespace halfspace::HS_LANES
