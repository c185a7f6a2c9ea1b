// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/parallel.h"

#include <pthread.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#ifndef HALFSPACE_STD_THREADS
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include "halfspace/core/available_cpus.h"
#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/task_check.h"
#include "halfspace/core/task_log.h"

namespace halfspace::HS_LANES {

namespace {

using Task = std::function<void(int)>;

/// Runs the tasks on the calling thread and on threads started for this call. No new task starts after an exception.
void run_on_std_threads(int threads, int count, const Task& task) {
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    const FloatMode mode;
    const detail::TaskScope scope;
    try {
      for (int i = next++; i < count; i = next++) {
        const detail::RecordedTask recorded;
        task(i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads && i < count; ++i) others.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace

#ifdef HALFSPACE_STD_THREADS

struct Workers::Impl {
  static std::unique_ptr<Impl> make(int) { return nullptr; }
  static bool works() { return false; }
  void run(int, const Task&) {}
};

#else

namespace {

/// Set in a child process after fork() if the parent had used TBB. The child has none of TBB's threads, and these may have held TBB's
/// locks.
std::atomic<bool> lost_tbb = false;

void watch_forks() {
  static const int kError = ::pthread_atfork(nullptr, nullptr, [] { lost_tbb = true; });
  if (kError != 0) throw std::bad_alloc();
}

}  // namespace

/// A team that runs on TBB's threads. The arena limits only our own tasks; other users of TBB in the process are unaffected.
struct Workers::Impl {
  explicit Impl(int threads) : arena(std::make_unique<tbb::task_arena>(threads)) { watch_forks(); }
  ~Impl() {
    if (!works()) static_cast<void>(arena.release());  // releasing an arena takes TBB locks
  }

  /// Returns null if TBB is not used: for one thread, or for more threads than cores, which TBB does not start.
  static std::unique_ptr<Impl> make(int threads) {
    return works() && threads > 1 && threads <= tbb::info::default_concurrency() ? std::make_unique<Impl>(threads) : nullptr;
  }

  /// Returns false after a fork() that made TBB unusable.
  static bool works() { return !lost_tbb.load(std::memory_order_relaxed); }

  void run(int count, const Task& task) {
    const auto work = [&task](int i) {
      const FloatMode mode;
      const detail::TaskScope scope;
      task(i);
    };
    // Grain size 1: a task is a tile or several thousand triangles, so stealing is cheap and gives the best load balance.
    arena->execute([&] { tbb::parallel_for(0, count, 1, work, tbb::simple_partitioner()); });
  }

  std::unique_ptr<tbb::task_arena> arena;
};

#endif

Workers::Workers(int threads, std::function<void()> before_task) : threads_(threads), before_task_(std::move(before_task)) {
  HS_CHECK_OP(threads, >=, 1, "Workers: the number of threads is not positive; expected at least 1");
  impl_ = Impl::make(threads);
}
Workers::~Workers() = default;

void Workers::for_each(int count, const std::function<void(int)>& task) const {
  if (!before_task_) return run(count, task);
  run(count, [&](int i) {
    before_task_();
    task(i);
  });
}

void Workers::run(int count, const std::function<void(int)>& task) const {
  const detail::RecordedPhase recorded(count);
  try {
    if (impl_ != nullptr && count > 1 && Impl::works() && !recorded.is_recorded()) {
      impl_->run(count, task);
    } else {
      run_on_std_threads(recorded.is_recorded() ? 1 : threads_, count, task);
    }
  } catch (const detail::TaskCheckFailure& failure) {
    detail::report_from_task(failure);
  }
}

int Workers::cores() { return available_cpus().count; }

}  // namespace halfspace::HS_LANES
