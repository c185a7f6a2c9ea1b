// SPDX-License-Identifier: Apache-2.0
//
// Distributes the shots of a batch to the threads of a team.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>

namespace halfspace::python {

/// The indices of the shots that are left. All functions are thread-safe.
class ShotQueue {
 public:
  /// The shots are first, ..., end - 1.
  ShotQueue(std::size_t first, std::size_t end) : next_(first), end_(end) {}

  /// Calls render(index) until no shots are left. If it throws, the exception is thrown again, and work() ends in the other threads too.
  /// Returns when no thread renders any more, so that the main thread handles signals until then.
  void work(const std::function<void(std::size_t)>& render);

  /// The workers that render a shot must call this function before each task. Throws an exception that work() catches if another thread has
  /// stopped the work, and handles signals (signals.h).
  void check() const;

 private:
  struct Stopped {};
  class Rendering;

  void wait_for_others();

  std::atomic<std::size_t> next_;
  const std::size_t end_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  int running_ = 0;  ///< threads that render; guarded by the mutex
};

}  // namespace halfspace::python
