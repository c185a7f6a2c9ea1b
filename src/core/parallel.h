// SPDX-License-Identifier: Apache-2.0
//
// Thread teams on top of TBB. A team uses std::thread instead if it has more threads than TBB would start, or if the build
// has no TBB (HALFSPACE_WITH_TBB=OFF, also used for ThreadSanitizer, which must see every lock). A single task, or a team of
// one, runs on the calling thread. In a child process after fork(), teams use std::thread, because TBB's threads do not exist there.
#pragma once

#include <functional>
#include <memory>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A team of threads. Results must never depend on the number of threads, which only determines who runs a task.
class Workers {
 public:
  /// Creates a team of `threads` >= 1 threads, including the calling thread. The count may exceed the number of cores. Other users of TBB
  /// in the process are not affected. A limit set by the host (tbb::global_control) applies to teams that run on TBB.
  ///
  /// before_task: called before each task, on the thread that will run it. If it throws, for_each() ends as if the task had thrown. A
  /// program can use it to stop a computation early. It must be thread-safe.
  explicit Workers(int threads, std::function<void()> before_task = {});
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Calls task(i) once for each i in [0, count) and returns when all calls have finished. Tasks run in any order, on any
  /// thread of the team, in the default IEEE floating-point mode (see FloatMode). If a task throws, no further tasks start, and
  /// one of the exceptions is rethrown to the caller after the running tasks have ended. A check that fails in a task is
  /// reported to the check handler (check.h) in the same way.
  void for_each(int count, const std::function<void(int)>& task) const;

  /// Returns the number of CPUs that this process can use, at least 1; see available_cpus.h.
  static int cores();

 private:
  struct Impl;
  void run(int count, const std::function<void(int)>& task) const;

  int threads_;
  std::function<void()> before_task_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace::HS_LANES
