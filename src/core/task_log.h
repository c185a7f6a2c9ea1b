// SPDX-License-Identifier: Apache-2.0
//
// A record of parallel work, from which the time with more threads can be predicted. halfspace-bench --scaling uses it.
#pragma once

#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// One call of Workers::for_each. Times are in milliseconds.
struct TaskPhase {
  double serial_ms = 0;          ///< since the end of the previous phase or the start of the recording
  std::vector<double> tasks_ms;  ///< duration of each task
};

/// Everything that a thread did, in order.
struct TaskLog {
  std::vector<TaskPhase> phases;
  double last_serial_ms = 0;  ///< after the last phase
};

/// Records the calls of Workers::for_each by the calling thread until it is destroyed. The thread runs all tasks itself, one after the
/// other, so that they do not disturb each other. The tasks are those of a team of Workers::threads() threads. Calls from within a task are
/// part of that task. There can be one recording per thread at a time.
class TaskRecording {
 public:
  explicit TaskRecording(TaskLog& log);
  ~TaskRecording();
  TaskRecording(const TaskRecording&) = delete;
  TaskRecording& operator=(const TaskRecording&) = delete;
};

namespace detail {

/// Called by Workers around each call of for_each and each of its tasks. Both do nothing unless this thread records.
class RecordedPhase {
 public:
  explicit RecordedPhase(int count);
  ~RecordedPhase();
  /// Returns whether this thread records and must run all tasks itself.
  bool is_recorded() const;
  RecordedPhase(const RecordedPhase&) = delete;
  RecordedPhase& operator=(const RecordedPhase&) = delete;
};
class RecordedTask {
 public:
  RecordedTask();
  ~RecordedTask();
  RecordedTask(const RecordedTask&) = delete;
  RecordedTask& operator=(const RecordedTask&) = delete;
};

}  // namespace detail

}  // namespace halfspace::HS_LANES
