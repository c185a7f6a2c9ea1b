// SPDX-License-Identifier: Apache-2.0
//
// Runs workloads side by side and measures their frames.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "workload.h"

namespace halfspace {

/// Times of one workload's frames, in milliseconds.
struct FrameTimes {
  int frames;
  double median, min, max;  ///< from start to end
  double cpu;               ///< of all threads together, the mean of a frame
};

/// Draws frames of workloads that are prepared, and takes their times.
class Runner {
 public:
  explicit Runner(const Workers& workers) : workers_(workers) {}

  /// Draws each workload for `seconds`, in rounds: every workload a part of its time in each, so that a machine that changes its
  /// speed changes it for all. The first frame of a round warms the caches and is not counted. 0 seconds: one frame of
  /// each, counted. The times are in the order of the workloads. step_done is called steps() times.
  std::vector<FrameTimes> run(const std::vector<std::unique_ptr<Workload>>& workloads, double seconds,
                              const std::function<void()>& step_done) const;
  static int steps(std::size_t workloads, double seconds);

 private:
  const Workers& workers_;
};

}  // namespace halfspace
