// SPDX-License-Identifier: Apache-2.0
//
// Tiles of an image that are drawn when a shader first needs them. A shader that reads an image by its own code names the texels before it
// reads them:
//
//   if (tiles != nullptr) tiles->require(i - 1, j - 1, i + 1, j + 1);
//
// raster/depth_on_demand.h draws the tiles of a depth image in this way.
#pragma once

#include <atomic>
#include <bit>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <type_traits>

#include "halfspace/core/lane_pairs.h"

namespace halfspace::HS_LANES {

/// Which tiles are drawn. Only DepthOnDemand derives from this class.
class TilesOnDemand {
 public:
  virtual ~TilesOnDemand() = default;
  TilesOnDemand(const TilesOnDemand&) = delete;
  TilesOnDemand& operator=(const TilesOnDemand&) = delete;

  /// Returns when the tiles that contain the texels from (x0, y0) to (x1, y1) are drawn; each lane has its own rectangle, with x0 <= x1 and
  /// y0 <= y1. Texels are counted from the lower left, as window coordinates are. Coordinates outside of the image are clamped. All texels
  /// that a lane reads must be named, also if their value is not used, because another thread may be drawing them. Thread-safe.
  ///
  /// Lanes without a pixel can have any coordinates, also those of NaN. Clamp a coordinate before adding an offset: if the sum wraps, x0 is
  /// above x1, and nothing is drawn.
  template <class I>
  HS_INLINE void require(I x0, I y0, I x1, I y1) const {
    const auto tile = [this](I texel, int end) { return I(min(max(texel, I(0)), I(end - 1)) >> tile_shift_); };
    const I left = tile(x0, width_), right = tile(x1, width_), low = tile(y0, height_), high = tile(y1, height_);
    const I first = low * I(tiles_x_) + left, last = high * I(tiles_x_) + right;
    using M = std::remove_cvref_t<decltype(first == last)>;
    // Most lanes need the same tile, so that one or two iterations suffice.
    for (uint32_t pending = kAllBits<M>; pending != 0;) {
      const int i = std::countr_zero(pending);
      const int32_t from = lane(first, i), to = lane(last, i);
      if (from != to || !is_drawn(from)) require_tiles(from, to);
      pending &= ~bits(M((first == I(from)) & (last == I(to))));
    }
  }
  template <class H>
  HS_INLINE void require(IntPair<H> x0, IntPair<H> y0, IntPair<H> x1, IntPair<H> y1) const {
    require(x0.low, y0.low, x1.low, y1.low);
    require(x0.high, y0.high, x1.high, y1.high);
  }

 protected:
  /// tile_size: a power of two.
  TilesOnDemand(int width, int height, int tile_size);

  /// Draws a tile unless it is drawn. If another thread is drawing it, waits for that thread.
  void require_tile(int tile_x, int tile_y) const;

 private:
  enum class State : uint8_t { missing, being_drawn, drawn };

  /// Draws a tile. Is called from any thread, but not for a tile that is drawn or being drawn; after an exception, it is called again. Must
  /// not require tiles of the same image.
  virtual void draw(int tile_x, int tile_y) const = 0;

  bool is_drawn(int32_t tile) const { return states_[static_cast<std::size_t>(tile)].load(std::memory_order_acquire) == State::drawn; }
  // Requires the rectangle of tiles from the lower left to the upper right one.
  void require_tiles(int32_t from, int32_t to) const;

  int width_, height_, tiles_x_, tile_shift_;
  std::unique_ptr<std::atomic<State>[]> states_;  // by rows
  mutable std::mutex mutex_;                      // held while a tile changes from being_drawn to another state
  mutable std::condition_variable finished_;
};

}  // namespace halfspace::HS_LANES
