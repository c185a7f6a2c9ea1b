// SPDX-License-Identifier: Apache-2.0
//
// Memory of a task that processes tiles. It is too large for the stack of a small thread and is therefore allocated from a pool.
#pragma once

#include <memory>

#include "halfspace/raster/shade/shade_deferred.h"
#include "halfspace/raster/tile/layers.h"
#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/visibility/sink/packet_queue.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

struct TileMemory {
  Tile tile;
  PacketQueue queue;
  DeferredShading shading;
  TransparentLayers layers;
  ColorBuffer post_color;                 ///< in the format of the post step's target
  std::unique_ptr<TileMemory> next_idle;  ///< next element in the pool
};

/// Takes a TileMemory from the pool, or allocates one, and returns it in the destructor. Its contents are undefined. The pool never
/// shrinks. Its size is the maximum number of elements that were in use at the same time. Thread-safe.
class TileMemoryLease {
 public:
  TileMemoryLease();
  ~TileMemoryLease();
  TileMemoryLease(const TileMemoryLease&) = delete;
  TileMemoryLease& operator=(const TileMemoryLease&) = delete;

  TileMemory& operator*() const { return *memory_; }

 private:
  std::unique_ptr<TileMemory> memory_;
};

}  // namespace halfspace::HS_LANES
