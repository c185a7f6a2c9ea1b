// SPDX-License-Identifier: Apache-2.0
//
// Measures the peak rates of this machine that limit a renderer. Each value is the best of several trials, because other processes can only
// make a trial slower.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "halfspace/core/parallel.h"

namespace halfspace {

/// One measured limit, for all threads together.
struct Limit {
  std::string name;
  std::string unit;
  double value;
};

/// Measures work that all threads execute in parallel.
class LimitTimer {
 public:
  /// Each trial takes about `seconds`.
  LimitTimer(int threads, double seconds) : workers_(threads), seconds_(seconds) {}

  int threads() const { return workers_.threads(); }

  /// Returns the highest rate of all trials, in units per second over all threads. work(thread, repeats) is called by all threads at the
  /// same time and must process `units` units per repeat.
  double best_rate(double units, const std::function<void(int thread, int repeats)>& work) const;

 private:
  double run(int repeats, const std::function<void(int thread, int repeats)>& work) const;
  Workers workers_;
  double seconds_;
};

/// Store, read and copy bandwidth of the L1 cache, the L2 cache and memory, in GB/s (10^9 bytes). Copied bytes count once. Also measures
/// non-temporal stores to memory.
std::vector<Limit> bandwidth_limits(const LimitTimer& timer);
/// Bandwidth of memset on images of 1920x1080 and 512x512 pixels with 4 bytes per pixel. Each thread sets an equal share of the bytes.
std::vector<Limit> frame_limits(const LimitTimer& timer);
/// Clock frequency (GHz, per thread), fused multiply-adds (GFLOP/s), and gathered lanes (10^9/s) from tables that fit into the L1 cache,
/// into the L2 cache, or into neither of them.
std::vector<Limit> compute_limits(const LimitTimer& timer);

}  // namespace halfspace
