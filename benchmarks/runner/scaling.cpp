// SPDX-License-Identifier: Apache-2.0
#include "runner/scaling.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>
#include <span>
#include <utility>

namespace halfspace {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// Time of a phase in which worker w takes as long for its tasks as logs[w % logs.size()] recorded.
double makespan(std::span<const TaskLog> logs, std::size_t phase, int workers) {
  using Worker = std::pair<double, std::size_t>;  // when it is free, and its number
  std::priority_queue<Worker, std::vector<Worker>, std::greater<>> free_at;
  for (std::size_t w = 0; w < static_cast<std::size_t>(workers); ++w) free_at.emplace(0.0, w);
  double end = 0;
  for (std::size_t task = 0; task < logs[0].phases[phase].tasks_ms.size(); ++task) {
    const auto [start, worker] = free_at.top();
    free_at.pop();
    free_at.emplace(start + logs[worker % logs.size()].phases[phase].tasks_ms[task], worker);
    end = std::max(end, start + logs[worker % logs.size()].phases[phase].tasks_ms[task]);
  }
  return end;
}

// The first two CPUs of the affinity mask, or one. Virtual machines may have CPUs of different speed.
std::vector<int> measured_cpus() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  std::vector<int> cpus;
  if (::sched_getaffinity(0, sizeof mask, &mask) != 0) return cpus;
  for (int cpu = 0; cpu < CPU_SETSIZE && cpus.size() < kMeasuredTeams; ++cpu) {
    if (CPU_ISSET(cpu, &mask)) cpus.push_back(cpu);
  }
  return cpus;
}

// Runs the calling thread on the given CPUs until it is destroyed.
class OnCpus {
 public:
  explicit OnCpus(std::span<const int> cpus) {
    CPU_ZERO(&before_);
    is_known_ = ::sched_getaffinity(0, sizeof before_, &before_) == 0;
    cpu_set_t mask;
    CPU_ZERO(&mask);
    for (const int cpu : cpus) CPU_SET(cpu, &mask);
    if (is_known_ && !cpus.empty()) ::sched_setaffinity(0, sizeof mask, &mask);
  }
  ~OnCpus() {
    if (is_known_) ::sched_setaffinity(0, sizeof before_, &before_);
  }
  OnCpus(const OnCpus&) = delete;
  OnCpus& operator=(const OnCpus&) = delete;

 private:
  cpu_set_t before_;
  bool is_known_;
};

double total_ms(const TaskLog& log) { return scheduled_ms(std::span(&log, 1), 1); }

// Draws two frames and replaces `fastest` by the record of the second if that is faster. The first frame only brings the data into the
// caches, where the second one finds it in a series of frames.
void record(Workload& workload, const Workers& team, TaskLog& fastest) {
  TaskLog log;
  for (int frame = 0; frame < 2; ++frame) {
    log = {};
    const TaskRecording recording(log);
    workload.frame(team);
  }
  if (fastest.phases.empty() || total_ms(log) < total_ms(fastest)) fastest = std::move(log);
}

double mean(std::span<const TaskLog> logs, double (*value)(const TaskLog&)) {
  double sum = 0;
  for (const TaskLog& log : logs) sum += value(log);
  return sum / static_cast<double>(logs.size());
}

std::size_t tasks_of(const TaskLog& log) {
  std::size_t count = 0;
  for (const TaskPhase& phase : log.phases) count += phase.tasks_ms.size();
  return count;
}

double ceiling(double serial_share, int workers) { return 1.0 / (serial_share + (1.0 - serial_share) / workers); }

}  // namespace

double scheduled_ms(std::span<const TaskLog> logs, int workers) {
  double ms = mean(logs, [](const TaskLog& log) { return log.last_serial_ms; });
  for (std::size_t phase = 0; phase < logs[0].phases.size(); ++phase) {
    for (const TaskLog& log : logs) ms += log.phases[phase].serial_ms / static_cast<double>(logs.size());
    ms += makespan(logs, phase, workers);
  }
  return ms;
}

double serial_ms(const TaskLog& log) {
  double ms = log.last_serial_ms;
  for (const TaskPhase& phase : log.phases) ms += phase.serial_ms + (phase.tasks_ms.size() == 1 ? phase.tasks_ms[0] : 0.0);
  return ms;
}

Scaling scaling_of(Workload& workload, double seconds) {
  std::vector<int> cpus = measured_cpus();
  if (cpus.empty()) cpus.push_back(0);
  std::vector<std::unique_ptr<Workers>> teams;
  for (const int threads : kTeams) teams.push_back(std::make_unique<Workers>(threads));
  std::vector<std::vector<TaskLog>> fastest(teams.size(), std::vector<TaskLog>(cpus.size()));  // of each team, on each CPU
  Scaling scaling;
  scaling.two_measured_ms = std::numeric_limits<double>::infinity();
  const Clock::time_point start = Clock::now();
  do {
    for (std::size_t cpu = 0; cpu < cpus.size(); ++cpu) {
      const OnCpus here({&cpus[cpu], 1});
      for (std::size_t i = 0; i < teams.size(); ++i) record(workload, *teams[i], fastest[i][cpu]);
    }
    for (int frame = 0; frame < 2; ++frame) {
      const Clock::time_point begin = Clock::now();
      workload.frame(*teams[1]);
      scaling.two_measured_ms = std::min(scaling.two_measured_ms, ms_since(begin));
    }
  } while (ms_since(start) < 1e3 * seconds);
  scaling.times.push_back(mean(fastest[0], total_ms));
  for (std::size_t i = 1; i < teams.size(); ++i) scaling.times.push_back(scheduled_ms(fastest[i], kTeams[i]));
  scaling.serial_ms = mean(fastest[0], serial_ms);
  scaling.log = std::move(fastest[0][0]);
  return scaling;
}

std::string scaling_title() {
  std::string title = fmt::format("{:24} {:>9} {:>8} {:>6} {:>6} {:>10} {:>10}", "workload", "1, ms", "serial", "phases", "tasks",
                                  "2, measured", "2, predicted");
  for (const int workers : std::span(kTeams).subspan(kMeasuredTeams)) title += fmt::format(" {:>14}", fmt::format("x{} (Amdahl)", workers));
  return title;
}

std::string scaling_row(std::string_view name, const Scaling& s) {
  const double one = s.times[0], share = s.serial_ms / one;
  std::string row = fmt::format("{:24} {:9.3f} {:7.2f}% {:6} {:6} {:11.3f} {:12.3f}", name, one, 100.0 * share, s.log.phases.size(),
                                tasks_of(s.log), s.two_measured_ms, s.times[1]);
  for (std::size_t i = kMeasuredTeams; i < s.times.size(); ++i)
    row += fmt::format(" {:>14}", fmt::format("{:.1f} ({:.1f})", one / s.times[i], ceiling(share, kTeams[i])));
  return row;
}

nlohmann::ordered_json scaling_json(std::string_view name, const Scaling& s) {
  const double one = s.times[0], share = s.serial_ms / one;
  nlohmann::ordered_json json = {{"workload", name},
                                 {"ms", one},
                                 {"serial_share", share},
                                 {"tasks", tasks_of(s.log)},
                                 {"two_threads", {{"measured_ms", s.two_measured_ms}, {"predicted_ms", s.times[1]}}}};
  for (const TaskPhase& phase : s.log.phases) {
    const double ms = std::accumulate(phase.tasks_ms.begin(), phase.tasks_ms.end(), 0.0);
    json["phases"].push_back({{"serial_ms", phase.serial_ms}, {"tasks", phase.tasks_ms.size()}, {"tasks_ms", ms}});
  }
  json["last_serial_ms"] = s.log.last_serial_ms;
  for (std::size_t i = kMeasuredTeams; i < s.times.size(); ++i)
    json["workers"].push_back({{"count", kTeams[i]}, {"speedup", one / s.times[i]}, {"amdahl", ceiling(share, kTeams[i])}});
  return json;
}

}  // namespace halfspace
