// SPDX-License-Identifier: Apache-2.0
#include "runner/runner.h"

#include <time.h>

#include <algorithm>
#include <chrono>

namespace halfspace {

namespace {

constexpr int kRounds = 5;

double wall_ms() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Returns the CPU time used by all threads of the process.
double cpu_ms() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Samples {
  std::vector<double> wall;
  double cpu = 0;
};

void time_frame(Workload& workload, const Workers& workers, Samples& samples) {
  const double cpu = cpu_ms(), wall = wall_ms();
  workload.frame(workers);
  samples.wall.push_back(wall_ms() - wall);
  samples.cpu += cpu_ms() - cpu;
}

FrameTimes times_of(Samples samples) {
  std::vector<double>& wall = samples.wall;
  std::ranges::sort(wall);
  const std::size_t middle = wall.size() / 2;
  const double median = wall.size() % 2 == 1 ? wall[middle] : 0.5 * (wall[middle - 1] + wall[middle]);
  return {static_cast<int>(wall.size()), median, wall.front(), wall.back(), samples.cpu / static_cast<double>(wall.size())};
}

}  // namespace

int Runner::steps(std::size_t workloads, double seconds) { return (seconds > 0 ? kRounds : 1) * static_cast<int>(workloads); }

std::vector<FrameTimes> Runner::run(const std::vector<std::unique_ptr<Workload>>& workloads, double seconds,
                                    const std::function<void()>& step_done) const {
  const double slice_ms = 1e3 * seconds / kRounds;
  std::vector<Samples> samples(workloads.size());
  for (int round = 0; round < (seconds > 0 ? kRounds : 1); ++round) {
    for (std::size_t i = 0; i < workloads.size(); ++i) {
      if (seconds > 0) workloads[i]->frame(workers_);
      const double end = wall_ms() + slice_ms;
      do time_frame(*workloads[i], workers_, samples[i]);
      while (wall_ms() < end);
      step_done();
    }
  }
  std::vector<FrameTimes> times;
  for (Samples& s : samples) times.push_back(times_of(std::move(s)));
  return times;
}

}  // namespace halfspace
