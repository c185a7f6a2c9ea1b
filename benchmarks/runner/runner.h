// SPDX-License-Identifier: Apache-2.0
//
// Measures the frame times of workloads.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "workloads/workload.h"

namespace halfspace {

/// Frame times of one workload, in milliseconds.
struct FrameTimes {
  int frames;
  double median, min, max;  ///< wall-clock time
  double cpu;               ///< CPU time of all threads, mean per frame
};

/// Draws frames of prepared workloads and measures their times.
class Runner {
 public:
  explicit Runner(const Workers& workers) : workers_(workers) {}

  /// Draws each workload for `seconds` in total. The time is split into rounds that visit all workloads, so that changes in the speed of
  /// the machine affect all of them alike. The first frame of a workload in each round warms the caches and is not counted. With 0
  /// seconds, draws and counts one frame of each workload. Returns the times in the order of the workloads. Calls step_done steps() times.
  std::vector<FrameTimes> run(const std::vector<std::unique_ptr<Workload>>& workloads, double seconds,
                              const std::function<void()>& step_done) const;
  static int steps(std::size_t workloads, double seconds);

 private:
  const Workers& workers_;
};

}  // namespace halfspace
