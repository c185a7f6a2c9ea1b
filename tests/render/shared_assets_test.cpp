// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/shared_assets.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>
#include <vector>

#include "support/sanitized.h"

namespace halfspace {
namespace {

constexpr std::size_t kHalfLimit = SharedAssets::kMaxBytes / 2;

// Returns the asset with this recipe, an integer that claims to have this size, and counts in `made` how often one is made.
std::shared_ptr<const int> get(SharedAssets& assets, const std::string& recipe, std::size_t bytes, int& made) {
  return assets.get<int>(
      recipe, [&] { return ++made; }, [&](int) { return bytes; });
}

TEST(SharedAssets, MakeEachAssetOnce) {
  SharedAssets assets;
  int made = 0;
  const auto a = get(assets, "a", 1, made), b = get(assets, "b", 1, made);
  EXPECT_EQ(get(assets, "a", 1, made), a);
  EXPECT_EQ(get(assets, "b", 1, made), b);
  EXPECT_NE(a, b);
  EXPECT_EQ(made, 2);
}

TEST(SharedAssets, DropTheOneThatHasNotBeenUsedForTheLongestTime) {
  SharedAssets assets;
  int made = 0;
  const std::weak_ptr<const int> a = get(assets, "a", kHalfLimit, made), b = get(assets, "b", kHalfLimit, made);
  EXPECT_FALSE(a.expired() || b.expired());
  get(assets, "a", kHalfLimit, made);
  get(assets, "c", 1, made);
  EXPECT_TRUE(b.expired());
  EXPECT_FALSE(a.expired());
  EXPECT_EQ(made, 3);
}

TEST(SharedAssets, DoNotKeepWhatExceedsTheLimit) {
  SharedAssets assets;
  int made = 0;
  const std::weak_ptr<const int> small = get(assets, "small", kHalfLimit, made);
  const std::weak_ptr<const int> large = get(assets, "large", SharedAssets::kMaxBytes + 1, made);
  EXPECT_TRUE(large.expired());
  EXPECT_FALSE(small.expired());
}

TEST(SharedAssets, ThreadsThatStartTogetherShareOneResult) {
  SharedAssets assets;
  std::atomic<int> made = 0;
  std::vector<std::shared_ptr<const int>> results(8);
  {
    std::vector<std::jthread> threads;
    for (auto& result : results) {
      threads.emplace_back([&] {
        result = assets.get<int>(
            "a", [&] { return ++made; }, [](int) { return std::size_t{1}; });
      });
    }
  }
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST(SharedAssets, CanBeUsedAfterAForkWhileOtherThreadsUseThem) {
  if (kSanitized) GTEST_SKIP() << "ThreadSanitizer does not support threads after fork()";
  SharedAssets::of_process();  // a child that is forked during the first use would wait for it, as for any static variable of a function
  std::atomic<bool> done = false;
  const std::jthread other([&] {
    for (int i = 0, made = 0; !done; ++i) get(SharedAssets::of_process(), "fork " + std::to_string(i % 3), 1, made);
  });
  for (int i = 0; i < 50; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(20);  // ends a child that waits for ever
      int made = 0;
      get(SharedAssets::of_process(), "child", 1, made);
      ::_exit(made == 1 ? 0 : 1);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  done = true;
}

}  // namespace
}  // namespace halfspace
