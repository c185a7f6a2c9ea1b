// SPDX-License-Identifier: Apache-2.0
//
// Predicts frame times with more threads than the machine has. The tasks of one thread are recorded (core/task_log.h) and scheduled on N
// workers; docs/explanation/scaling.md states what this leaves out.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/task_log.h"
#include "workloads/workload.h"

namespace halfspace {

/// Returns the time of the recorded work with N workers: phases one after the other, and in each phase, the tasks in order, each by the
/// worker that is free first.
double scheduled_ms(const TaskLog& log, int workers);

/// Returns the time in which only one thread has work, however many there are: before, between and after phases, and in phases with a
/// single task.
double serial_ms(const TaskLog& log);

struct Scaling {
  double one_ms = 0;     ///< recorded time with one thread
  double serial_ms = 0;  ///< part of it, see serial_ms()
  TaskLog log;
  double two_measured_ms = 0;  ///< with two threads
  double two_ms = 0;           ///< the same, predicted
  std::vector<double> times;   ///< predicted, for kWorkerCounts
};
inline constexpr int kWorkerCounts[] = {8, 16, 64, 128};

/// Draws frames with one and with two threads in turn for `seconds`, and returns the results for the fastest frame of each.
Scaling scaling_of(Workload& workload, double seconds);

/// Return the title of the table, and the results of a workload as a row of it or as JSON. Amdahl's ceiling for N workers is
/// 1 / (s + (1 - s) / N), where s is the serial share (G. M. Amdahl, 1967).
std::string scaling_title();
std::string scaling_row(std::string_view name, const Scaling& scaling);
nlohmann::ordered_json scaling_json(std::string_view name, const Scaling& scaling);

}  // namespace halfspace
