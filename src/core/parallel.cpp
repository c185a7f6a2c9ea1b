// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/parallel.h"

#include <thread>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/task_check.h"

#ifdef HALFSPACE_STD_THREADS

#include <atomic>
#include <exception>
#include <mutex>
#include <vector>

namespace halfspace {

struct Workers::Impl {};

Workers::Workers(int threads) : threads_(threads) { HS_CHECK_OP(threads, >=, 1); }
Workers::~Workers() = default;

void Workers::run_tasks(int count, const std::function<void(int)>& task) const {
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    const FloatMode mode;
    const detail::TaskScope scope;
    try {
      for (int i = next++; i < count; i = next++) task(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads_ && i < count; ++i) others.emplace_back(work);
  work();
  for (std::thread& t : others) t.join();
  if (error) std::rethrow_exception(error);
}

#else

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace halfspace {

struct Workers::Impl {
  explicit Impl(int threads) : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control control;  // more threads than cores only where this allows it
  tbb::task_arena arena;
};

Workers::Workers(int threads) : threads_(threads) {
  HS_CHECK_OP(threads, >=, 1);
  if (threads > 1) impl_ = std::make_unique<Impl>(threads);
}
Workers::~Workers() = default;

void Workers::run_tasks(int count, const std::function<void(int)>& task) const {
  const auto guarded = [&task](int i) {
    const FloatMode mode;
    const detail::TaskScope scope;
    task(i);
  };
  if (threads_ == 1 || count <= 1) {
    for (int i = 0; i < count; ++i) guarded(i);
    return;
  }
  // One task at a time: each is a tile or some thousand triangles, so stealing costs little and balance is best.
  impl_->arena.execute([&] { tbb::parallel_for(0, count, 1, guarded, tbb::simple_partitioner()); });
}

#endif

void Workers::for_each(int count, const std::function<void(int)>& task) const {
  try {
    run_tasks(count, task);
  } catch (const detail::TaskCheckFailure& failure) {
    detail::report_from_task(failure);
  }
}

int Workers::cores() {
  const unsigned n = std::thread::hardware_concurrency();
  return n == 0 ? 1 : static_cast<int>(n);
}

}  // namespace halfspace
