// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/task_log.h"

#include <chrono>

namespace halfspace::HS_LANES {

namespace {

using Clock = std::chrono::steady_clock;

// The recording of this thread.
struct Recorder {
  TaskLog* log = nullptr;
  int depth = 0;  // calls of for_each that contain each other
  Clock::time_point phase_end, task_start;
};
thread_local Recorder recorder;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

}  // namespace

TaskRecording::TaskRecording(TaskLog& log) {
  log = {};
  recorder = {&log, 0, Clock::now(), {}};
}

TaskRecording::~TaskRecording() {
  recorder.log->last_serial_ms = ms_since(recorder.phase_end);
  recorder.log = nullptr;
}

namespace detail {

RecordedPhase::RecordedPhase(int count) {
  if (recorder.log == nullptr || recorder.depth++ > 0) return;
  recorder.log->phases.push_back({ms_since(recorder.phase_end), {}});
  recorder.log->phases.back().tasks_ms.reserve(static_cast<std::size_t>(count));
}

RecordedPhase::~RecordedPhase() {
  if (recorder.log != nullptr && --recorder.depth == 0) recorder.phase_end = Clock::now();
}

bool RecordedPhase::is_recorded() const { return recorder.log != nullptr; }

RecordedTask::RecordedTask() {
  if (recorder.log != nullptr && recorder.depth == 1) recorder.task_start = Clock::now();
}

RecordedTask::~RecordedTask() {
  if (recorder.log != nullptr && recorder.depth == 1) recorder.log->phases.back().tasks_ms.push_back(ms_since(recorder.task_start));
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
