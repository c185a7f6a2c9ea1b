// SPDX-License-Identifier: Apache-2.0
//
// Predicts frame times with more threads than the machine has. The tasks of a team of N threads are run by one thread, recorded
// (core/task_log.h), and scheduled on N workers; docs/explanation/scaling.md states what this leaves out.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/task_log.h"
#include "workloads/workload.h"

namespace halfspace {

/// Returns the time of the recorded work with N workers: phases one after the other, and in each phase, the tasks in order, each by the
/// worker that is free first. logs: records of the same tasks on different CPUs; the workers have their speeds in turn. The time between
/// phases is the mean.
double scheduled_ms(std::span<const TaskLog> logs, int workers);

/// Returns the time in which only one thread has work, however many there are: before, between and after phases, and in phases with a
/// single task.
double serial_ms(const TaskLog& log);

/// The numbers of threads for which times are predicted. The first two can be compared with measured times.
inline constexpr int kTeams[] = {1, 2, 8, 16, 64, 128};
inline constexpr std::size_t kMeasuredTeams = 2;

struct Scaling {
  std::vector<double> times;   ///< with the teams of kTeams, predicted from the tasks of each, in milliseconds
  double two_measured_ms = 0;  ///< with two threads
  double serial_ms = 0;        ///< of one thread, see serial_ms()
  TaskLog log;                 ///< of one thread
};

/// Draws frames for `seconds`: in turn, two for each team, of which one thread runs all tasks, on each of two CPUs, and two with two
/// threads. Returns the results for the fastest frame of each. The time and the serial share of one thread are means over the CPUs.
Scaling scaling_of(Workload& workload, double seconds);

/// Return the title of the table, and the results of a workload as a row of it or as JSON. Amdahl's ceiling for N workers is
/// 1 / (s + (1 - s) / N), where s is the serial share (G. M. Amdahl, 1967).
std::string scaling_title();
std::string scaling_row(std::string_view name, const Scaling& scaling);
nlohmann::ordered_json scaling_json(std::string_view name, const Scaling& scaling);

}  // namespace halfspace
