// SPDX-License-Identifier: Apache-2.0
//
// What this machine can do at best, in the terms that bound a renderer. Each figure is the best of several trials: a limit is what
// nothing else took part of.
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

/// Times a piece of work that threads do side by side.
class LimitTimer {
 public:
  /// Every trial of every limit lasts about `seconds`.
  LimitTimer(int threads, double seconds) : workers_(threads), seconds_(seconds) {}

  int threads() const { return workers_.threads(); }

  /// The largest number of units a second that any trial reached. work(thread, repeats) is called by each thread at once and does
  /// `units` units a repeat.
  double best_rate(double units, const std::function<void(int thread, int repeats)>& work) const;

 private:
  double run(int repeats, const std::function<void(int thread, int repeats)>& work) const;
  Workers workers_;
  double seconds_;
};

/// Store, read and copy in the first and second level of cache and in memory, GB/s (10^9 bytes); copied bytes count once. Stores to
/// memory also past the caches.
std::vector<Limit> bandwidth_limits(const LimitTimer& timer);
/// memset of the bytes of a picture of 1920x1080 and of 512x512 pixels, 4 bytes each; each thread its share of the rows.
std::vector<Limit> frame_limits(const LimitTimer& timer);
/// Clock (GHz, of one thread), fused multiply-adds (GFLOP/s), gathered lanes (10^9/s) from tables in the first and second level of
/// cache and beyond.
std::vector<Limit> compute_limits(const LimitTimer& timer);

}  // namespace halfspace
