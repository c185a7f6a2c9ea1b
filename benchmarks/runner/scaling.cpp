// SPDX-License-Identifier: Apache-2.0
#include "runner/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>

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
  const Workers one(1), two(2);
  TaskLog best;
  double best_ms = std::numeric_limits<double>::infinity(), two_ms = best_ms;
  workload.frame(one);
  workload.frame(two);
  const Clock::time_point start = Clock::now();
  do {
    TaskLog log;
    {
      const TaskRecording recording(log);
      workload.frame(one);
    }
    if (const double ms = total_ms(log); ms < best_ms) {
      best_ms = ms;
      best = std::move(log);
    }
    const Clock::time_point frame = Clock::now();
    workload.frame(two);
    two_ms = std::min(two_ms, ms_since(frame));
  } while (ms_since(start) < 1e3 * seconds);
  Scaling scaling{
      .one_ms = best_ms, .serial_ms = serial_ms(best), .log = {}, .two_measured_ms = two_ms, .two_ms = scheduled_ms(best, 2), .times = {}};
  for (const int workers : kWorkerCounts) scaling.times.push_back(scheduled_ms(best, workers));
  scaling.log = std::move(best);
  return scaling;
}

std::string scaling_title() {
  std::string title = fmt::format("{:24} {:>9} {:>8} {:>6} {:>6} {:>10} {:>10}", "workload", "1, ms", "serial", "phases", "tasks",
                                  "2, measured", "2, predicted");
  for (const int workers : kWorkerCounts) title += fmt::format(" {:>14}", fmt::format("x{} (Amdahl)", workers));
  return title;
}

std::string scaling_row(std::string_view name, const Scaling& s) {
  const double share = s.serial_ms / s.one_ms;
  std::string row = fmt::format("{:24} {:9.3f} {:7.2f}% {:6} {:6} {:11.3f} {:12.3f}", name, s.one_ms, 100.0 * share, s.log.phases.size(),
                                tasks_of(s.log), s.two_measured_ms, s.two_ms);
  for (std::size_t i = 0; i < s.times.size(); ++i)
    row += fmt::format(" {:>14}", fmt::format("{:.1f} ({:.1f})", s.one_ms / s.times[i], ceiling(share, kWorkerCounts[i])));
  return row;
}

nlohmann::ordered_json scaling_json(std::string_view name, const Scaling& s) {
  const double share = s.serial_ms / s.one_ms;
  nlohmann::ordered_json json = {{"workload", name},
                                 {"ms", s.one_ms},
                                 {"serial_share", share},
                                 {"tasks", tasks_of(s.log)},
                                 {"two_threads", {{"measured_ms", s.two_measured_ms}, {"predicted_ms", s.two_ms}}}};
  for (const TaskPhase& phase : s.log.phases) {
    const double ms = std::accumulate(phase.tasks_ms.begin(), phase.tasks_ms.end(), 0.0);
    json["phases"].push_back({{"serial_ms", phase.serial_ms}, {"tasks", phase.tasks_ms.size()}, {"tasks_ms", ms}});
  }
  json["last_serial_ms"] = s.log.last_serial_ms;
  for (std::size_t i = 0; i < s.times.size(); ++i)
    json["workers"].push_back(
        {{"count", kWorkerCounts[i]}, {"speedup", s.one_ms / s.times[i]}, {"amdahl", ceiling(share, kWorkerCounts[i])}});
  return json;
}

}  // namespace halfspace
