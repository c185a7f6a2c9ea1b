// SPDX-License-Identifier: Apache-2.0
//
// Threads. A team runs on TBB, or on std::thread: where TBB is absent (HALFSPACE_STD_THREADS, also for ThreadSanitizer,
// which must see every lock), and where the team is larger than the machine.
#pragma once

#include <functional>
#include <memory>

namespace halfspace {

/// A team of threads. Results must never depend on its size: it decides who does a task, not what a task does.
class Workers {
 public:
  /// threads >= 1 counts the calling thread; it may exceed the machine's cores. Other users of TBB in the process are
  /// not affected. A limit that the host sets (tbb::global_control) holds for teams up to the machine's cores.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return threads_; }

  /// Calls task(i) once for every i in [0, count), in any order, on any of the threads, in IEEE's default float mode
  /// (FloatMode), and returns when all are done. If tasks throw, no further task starts, and one of the exceptions is
  /// rethrown here when none is running. A check that fails in a task reaches the check handler (check.h) here too.
  void for_each(int count, const std::function<void(int)>& task) const;

  /// The number of cores this process may use.
  static int cores();

 private:
  struct Impl;
  int threads_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfspace
