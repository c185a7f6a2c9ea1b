// SPDX-License-Identifier: Apache-2.0
//
// Measures the time of draws with DrawState::timer.
#pragma once

#include <chrono>
#include <optional>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Adds its lifetime to a part of the time of a draw, if the draw has a timer.
class DrawStopwatch {
 public:
  /// The statistics must outlive this object.
  DrawStopwatch(const Draw& draw, double DrawTime::*part, PassStatistics& statistics)
      : timer_(draw.state.timer), part_(part), statistics_(statistics) {
    if (timer_) start_ = Clock::now();
  }
  DrawStopwatch(const DrawStopwatch&) = delete;
  DrawStopwatch& operator=(const DrawStopwatch&) = delete;
  ~DrawStopwatch() {
    if (!timer_) return;
    DrawTime time;
    time.*part_ = std::chrono::duration<double>(Clock::now() - start_).count();
    statistics_.add_time(*timer_, time);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<uint32_t> timer_;
  double DrawTime::*part_;
  PassStatistics& statistics_;
  Clock::time_point start_{};
};

}  // namespace halfspace::HS_LANES
