// SPDX-License-Identifier: Apache-2.0
//
// Measures the time of draws with DrawState::timer.
#pragma once

#include <chrono>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Returns the timer of a draw, or null.
inline const uint32_t* timer_of(const Draw& draw) { return draw.state.timer ? &*draw.state.timer : nullptr; }

/// Adds its lifetime to a part of the time of a draw, if the draw has a timer.
class DrawStopwatch {
 public:
  /// The statistics must outlive this object. timer: see timer_of().
  DrawStopwatch(const uint32_t* timer, double DrawTime::*part, PassStatistics& statistics)
      : timer_(timer), part_(part), statistics_(statistics) {
    if (timer_ != nullptr) start_ = Clock::now();
  }
  DrawStopwatch(const Draw& draw, double DrawTime::*part, PassStatistics& statistics) : DrawStopwatch(timer_of(draw), part, statistics) {}
  DrawStopwatch(const DrawStopwatch&) = delete;
  DrawStopwatch& operator=(const DrawStopwatch&) = delete;
  ~DrawStopwatch() {
    if (timer_ == nullptr) return;
    DrawTime time;
    time.*part_ = std::chrono::duration<double>(Clock::now() - start_).count();
    statistics_.add_time(*timer_, time);
  }

 private:
  using Clock = std::chrono::steady_clock;

  const uint32_t* timer_;
  double DrawTime::*part_;
  PassStatistics& statistics_;
  Clock::time_point start_{};
};

}  // namespace halfspace::HS_LANES
