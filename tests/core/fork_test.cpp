// SPDX-License-Identifier: Apache-2.0
//
// Thread teams in a child process. The parent used its threads before the fork; none of them exist in the child.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "halfspace/core/parallel.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

constexpr unsigned kPatienceSeconds = 60;

bool runs_all_tasks(const Workers& workers) {
  std::vector<std::atomic<int>> runs(1000);
  workers.for_each(1000, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
  for (const std::atomic<int>& r : runs) {
    if (r != 1) return false;
  }
  return true;
}

/// Returns whether n tasks run at the same time: each waits until all have started.
bool runs_at_once(const Workers& workers, int n) {
  std::mutex mutex;
  std::condition_variable all_are_here;
  int started = 0;
  std::atomic<bool> timed_out = false;
  workers.for_each(n, [&](int) {
    std::unique_lock lock(mutex);
    ++started;
    all_are_here.notify_all();
    if (!all_are_here.wait_for(lock, std::chrono::seconds(kPatienceSeconds / 2), [&] { return started == n; })) timed_out = true;
  });
  return !timed_out;
}

/// Runs a function in a child process and returns its result, or false if the child did not end in time.
template <class F>
bool in_child(F&& function) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(kPatienceSeconds);
    ::_exit(function() ? 0 : 1);
  }
  int status = -1;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Fork, TeamsOfTheParentRunInTheChild) {
  if (kSanitized) GTEST_SKIP() << "ThreadSanitizer does not support threads after fork()";
  for (const int threads : {2, Workers::cores(), Workers::cores() + 1}) {
    const Workers workers(threads);
    EXPECT_TRUE(runs_all_tasks(workers));
    EXPECT_TRUE(in_child([&] { return runs_all_tasks(workers); })) << threads << " threads";
    EXPECT_TRUE(runs_all_tasks(workers)) << "the parent was affected";
  }
}

TEST(Fork, TeamsOfTheParentRunInParallelInTheChild) {
  if (kSanitized) GTEST_SKIP() << "ThreadSanitizer does not support threads after fork()";
  const int threads = Workers::cores();
  const Workers workers(threads);
  EXPECT_TRUE(runs_all_tasks(workers));
  EXPECT_TRUE(in_child([&] { return runs_at_once(workers, threads); }));
}

TEST(Fork, TeamsCanBeCreatedAndDestroyedInTheChild) {
  if (kSanitized) GTEST_SKIP() << "ThreadSanitizer does not support threads after fork()";
  auto parent_team = std::make_unique<Workers>(2);
  EXPECT_TRUE(runs_all_tasks(*parent_team));
  EXPECT_TRUE(in_child([&] {
    parent_team.reset();
    const Workers workers(2);
    return runs_all_tasks(workers) && in_child([&] { return runs_all_tasks(workers); });
  }));
  EXPECT_TRUE(runs_all_tasks(*parent_team));
}

TEST(Fork, ManyChildrenRunAtOnce) {
  if (kSanitized) GTEST_SKIP() << "ThreadSanitizer does not support threads after fork()";
  const Workers workers(2);
  std::vector<pid_t> children;
  for (int i = 0; i < 16; ++i) {
    EXPECT_TRUE(runs_all_tasks(workers));  // TBB's threads are awake when the child is created
    children.push_back(::fork());
    if (children.back() == 0) {
      ::alarm(kPatienceSeconds);
      ::_exit(runs_all_tasks(workers) ? 0 : 1);
    }
  }
  for (const pid_t child : children) {
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
}

}  // namespace
}  // namespace halfspace
