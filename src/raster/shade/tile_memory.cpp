// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/tile_memory.h"

#include <mutex>
#include <utility>

namespace halfspace::HS_LANES {

namespace {

struct Pool {
  std::mutex mutex;
  std::unique_ptr<TileMemory> first_idle;
};
Pool& pool() {
  static Pool p;
  return p;
}

std::unique_ptr<TileMemory> take() {
  Pool& p = pool();
  const std::lock_guard lock(p.mutex);
  std::unique_ptr<TileMemory> memory = std::move(p.first_idle);
  if (memory != nullptr) p.first_idle = std::move(memory->next_idle);
  return memory;
}

}  // namespace

// make_unique would clear memory that is initialized for each tile anyway.
TileMemoryLease::TileMemoryLease() : memory_(take()) {
  if (memory_ == nullptr) memory_.reset(new TileMemory);
}

TileMemoryLease::~TileMemoryLease() {
  Pool& p = pool();
  const std::lock_guard lock(p.mutex);
  memory_->next_idle = std::move(p.first_idle);
  p.first_idle = std::move(memory_);
}

}  // namespace halfspace::HS_LANES
