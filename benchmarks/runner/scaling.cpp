// SPDX-License-Identifier: Apache-2.0
#include "runner/scaling.h"

#include <fmt/format.h>

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

double makespan(const std::vector<double>& tasks, int workers) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;  // when each worker that has had a task is free
  double end = 0;
  for (const double task : tasks) {
    double start = 0;
    if (static_cast<int>(free_at.size()) == workers) {
      start = free_at.top();
      free_at.pop();
    }
    free_at.push(start + task);
    end = std::max(end, start + task);
  }
  return end;
}

double total_ms(const TaskLog& log) { return scheduled_ms(log, 1); }

std::size_t tasks_of(const TaskLog& log) {
  std::size_t count = 0;
  for (const TaskPhase& phase : log.phases) count += phase.tasks_ms.size();
  return count;
}

double ceiling(double serial_share, int workers) { return 1.0 / (serial_share + (1.0 - serial_share) / workers); }

}  // namespace

double scheduled_ms(const TaskLog& log, int workers) {
  double ms = log.last_serial_ms;
  for (const TaskPhase& phase : log.phases) ms += phase.serial_ms + makespan(phase.tasks_ms, workers);
  return ms;
}

double serial_ms(const TaskLog& log) {
  double ms = log.last_serial_ms;
  for (const TaskPhase& phase : log.phases) ms += phase.serial_ms + (phase.tasks_ms.size() == 1 ? phase.tasks_ms[0] : 0.0);
  return ms;
}

Scaling scaling_of(Workload& workload, double seconds) {
  std::vector<std::unique_ptr<Workers>> teams;
  for (const int threads : kTeams) teams.push_back(std::make_unique<Workers>(threads));
  std::vector<TaskLog> fastest(teams.size());
  Scaling scaling;
  scaling.two_measured_ms = std::numeric_limits<double>::infinity();
  workload.frame(*teams[1]);
  const Clock::time_point start = Clock::now();
  do {
    for (std::size_t i = 0; i < teams.size(); ++i) {
      TaskLog log;
      {
        const TaskRecording recording(log);
        workload.frame(*teams[i]);
      }
      if (fastest[i].phases.empty() || total_ms(log) < total_ms(fastest[i])) fastest[i] = std::move(log);
    }
    const Clock::time_point frame = Clock::now();
    workload.frame(*teams[1]);
    scaling.two_measured_ms = std::min(scaling.two_measured_ms, ms_since(frame));
  } while (ms_since(start) < 1e3 * seconds);
  for (std::size_t i = 0; i < teams.size(); ++i) scaling.times.push_back(scheduled_ms(fastest[i], kTeams[i]));
  scaling.serial_ms = serial_ms(fastest[0]);
  scaling.log = std::move(fastest[0]);
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
