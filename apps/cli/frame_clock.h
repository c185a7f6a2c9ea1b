// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace halfspace {

/// When the frames of an animation start, in units of its format. Times are rounded, not durations, so that errors do not add up.
class FrameClock {
 public:
  FrameClock(double fps, double units_per_second) : fps_(fps), units_per_second_(units_per_second) {}
  int64_t start_of(int frame) const { return std::llround(frame * units_per_second_ / fps_); }
  int64_t duration_of(int frame) const { return start_of(frame + 1) - start_of(frame); }

 private:
  double fps_, units_per_second_;
};

}  // namespace halfspace
