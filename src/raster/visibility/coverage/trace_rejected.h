// SPDX-License-Identifier: Apache-2.0
//
// Records fragments that hierarchical Z rejects together. The pipeline does not compute which samples they cover, so these functions do.
#pragma once

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/tests/depth_bounds.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// One sample of a triangle, point or line in a tile.
struct RejectedPrimitive {
  const DrawInTile& d;
  const Triangle& triangle;
  TriangleId id;
  std::size_t sample;
  DepthBounds z;  ///< bounds of its depth
};

/// Records that a block of the tile's storage was rejected because of its depth bounds, which must not have changed since then.
void trace_rejected_block(const RejectedPrimitive& primitive, int block, TileTrace& trace);

/// Records that the tile was rejected. stored: depth bounds of the tile.
void trace_rejected_tile(const RejectedPrimitive& primitive, const DepthBounds& stored, TileTrace& trace);

/// The same, with the bounds over all blocks of the tile.
void trace_rejected_tile(const RejectedPrimitive& primitive, TileTrace& trace);

}  // namespace halfspace::HS_LANES
