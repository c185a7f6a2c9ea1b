// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/texture/tiles_on_demand.h"

namespace halfspace::HS_LANES {

TilesOnDemand::TilesOnDemand(int width, int height, int tile_size)
    : width_(width),
      height_(height),
      tiles_x_((width + tile_size - 1) / tile_size),
      tile_shift_(std::countr_zero(static_cast<unsigned>(tile_size))),
      states_(std::make_unique<std::atomic<State>[]>(static_cast<std::size_t>(tiles_x_) *
                                                     static_cast<std::size_t>((height + tile_size - 1) / tile_size))) {}

void TilesOnDemand::require_tiles(int32_t from, int32_t to) const {
  for (int y = from / tiles_x_; y <= to / tiles_x_; ++y) {
    for (int x = from % tiles_x_; x <= to % tiles_x_; ++x) {
      if (!is_drawn(y * tiles_x_ + x)) require_tile(x, y);
    }
  }
}

void TilesOnDemand::require_tile(int tile_x, int tile_y) const {
  std::atomic<State>& state = states_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)];
  const auto set_state = [&](State s) {
    {
      const std::lock_guard lock(mutex_);
      state.store(s, std::memory_order_release);
    }
    finished_.notify_all();
  };
  for (;;) {
    State seen = State::missing;
    if (state.compare_exchange_strong(seen, State::being_drawn, std::memory_order_acquire)) break;
    if (seen == State::drawn) return;
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [&] { return state.load(std::memory_order_acquire) != State::being_drawn; });
  }
  try {
    draw(tile_x, tile_y);
  } catch (...) {
    set_state(State::missing);
    throw;
  }
  set_state(State::drawn);
}

}  // namespace halfspace::HS_LANES
