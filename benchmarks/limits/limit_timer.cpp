// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include "limits/limits.h"

namespace halfspace {

namespace {

constexpr int kTrials = 15;

}  // namespace

double LimitTimer::run(int repeats, const std::function<void(int thread, int repeats)>& work) const {
  const auto start = std::chrono::steady_clock::now();
  workers_.for_each(threads(), [&](int thread) { work(thread, repeats); });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double LimitTimer::best_rate(double units, const std::function<void(int thread, int repeats)>& work) const {
  int repeats = 1;
  double took = run(repeats, work);  // also touches all memory
  while (took < 0.1 * seconds_) took = run(repeats *= 4, work);
  repeats = std::max(static_cast<int>(repeats * seconds_ / took), 1);
  double best = 0;
  for (int trial = 0; trial < kTrials; ++trial) best = std::max(best, units * repeats * threads() / run(repeats, work));
  return best;
}

}  // namespace halfspace
