// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#ifdef HALFSPACE_TEST_TBB
#include <tbb/global_control.h>
#endif

namespace halfspace {
namespace {

constexpr std::chrono::seconds kPatience{60};

TEST(Workers, RunEveryTaskOnce) {
  for (const int threads : {1, 2, 7, Workers::cores(), Workers::cores() + 1}) {
    const Workers workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    for (const int count : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
      workers.for_each(count, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
      for (const std::atomic<int>& r : runs) EXPECT_EQ(r, 1);
    }
  }
}

/// Runs n tasks, each of which waits until all n have started, and returns the threads that ran them.
std::set<std::thread::id> threads_at_barrier(const Workers& workers, int n) {
  std::mutex mutex;
  std::condition_variable all_are_here;
  std::set<std::thread::id> threads;
  workers.for_each(n, [&](int) {
    std::unique_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
    all_are_here.notify_all();
    all_are_here.wait_for(lock, kPatience, [&] { return threads.size() == static_cast<std::size_t>(n); });
  });
  return threads;
}

TEST(Workers, CanHaveMoreThreadsThanCores) {
  for (const int threads : {Workers::cores() + 1, 2 * Workers::cores() + 3}) {
    const std::set<std::thread::id> ids = threads_at_barrier(Workers(threads), threads);
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(threads));
    EXPECT_EQ(ids.count(std::this_thread::get_id()), 1u);
  }
}

TEST(Workers, NeverRunMoreTasksAtOnceThanThreads) {
  for (const int threads : {1, 2, Workers::cores() + 1}) {
    const Workers workers(threads);
    std::atomic<int> running = 0, max_running = 0;
    workers.for_each(200, [&](int) {
      const int now = ++running;
      for (int seen = max_running; seen < now && !max_running.compare_exchange_weak(seen, now);) {
      }
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      --running;
    });
    EXPECT_LE(max_running, threads);
  }
}

TEST(Workers, CallTheFunctionBeforeEachTaskOnItsThread) {
  for (const int threads : {1, 2, Workers::cores() + 1}) {
    static thread_local int announced = 0;
    std::atomic<int> calls = 0, misplaced = 0;
    const Workers workers(threads, [&] {
      ++announced;
      ++calls;
    });
    workers.for_each(100, [&](int) {
      if (--announced != 0) ++misplaced;
    });
    EXPECT_EQ(calls, 100) << threads;
    EXPECT_EQ(misplaced, 0) << threads;
  }
}

// Each thread may have started one more task when the function throws.
TEST(Workers, StopBeforeTheNextTaskIfTheFunctionThrows) {
  struct Stop {};
  for (const int threads : {1, 2, Workers::cores() + 1}) {
    std::atomic<bool> stop = false;
    std::atomic<int> late = 0;
    const Workers workers(threads, [&] {
      if (stop) throw Stop();
    });
    EXPECT_THROW(workers.for_each(1000,
                                  [&](int i) {
                                    if (stop) ++late;
                                    if (i == 3) stop = true;
                                  }),
                 Stop)
        << threads;
    EXPECT_LE(late, threads) << threads;
    stop = false;
    std::atomic<int> done = 0;
    workers.for_each(10, [&](int) { ++done; });
    EXPECT_EQ(done, 10) << "the team can be used again";
  }
}

#ifdef HALFSPACE_TEST_TBB

std::size_t tbb_limit() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); }

// Checks that the process-wide TBB limit does not change while a pool exists and runs tasks.
void expect_limit_unchanged(std::size_t limit) {
  EXPECT_EQ(tbb_limit(), limit);
  for (const int threads : {1, 2, Workers::cores(), Workers::cores() + 5}) {
    const Workers workers(threads);
    EXPECT_EQ(tbb_limit(), limit) << threads;
    std::atomic<int> done = 0;
    workers.for_each(50, [&](int) {
      EXPECT_EQ(tbb_limit(), limit) << threads;
      ++done;
    });
    EXPECT_EQ(done, 50);
  }
  EXPECT_EQ(tbb_limit(), limit);
}

TEST(Workers, DoNotChangeTheTbbLimitOfTheHost) {
  expect_limit_unchanged(tbb_limit());
  for (const std::size_t limit : {std::size_t{1}, std::size_t{64}}) {
    const tbb::global_control host(tbb::global_control::max_allowed_parallelism, limit);
    expect_limit_unchanged(limit);
  }
}

#endif

}  // namespace
}  // namespace halfspace
