// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/check.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "halfspace/core/parallel.h"

namespace halfspace {
namespace {

struct CheckFailed : std::logic_error {
  explicit CheckFailed(const CheckFailure& f)
      : std::logic_error(f.message), file(f.file), line(f.line), thread(std::this_thread::get_id()) {}
  std::string file;
  int line;
  std::thread::id thread;  ///< thread that ran the handler
};

int handler_calls = 0;

void throw_failure(const CheckFailure& f) {
  ++handler_calls;
  throw CheckFailed(f);
}

void return_from_failure(const CheckFailure&) { ++handler_calls; }

class CheckHandlerTest : public testing::Test {
 protected:
  CheckHandlerTest() {
    handler_calls = 0;
    set_check_handler(throw_failure);
  }
  ~CheckHandlerTest() override { set_check_handler(nullptr); }
};

/// Calls function, which must fail a check, and returns that failure.
template <class F>
CheckFailed failure_of(const F& function) {
  try {
    function();
  } catch (const CheckFailed& f) {
    return f;
  }
  ADD_FAILURE() << "no check failed";
  return CheckFailed({"", 0, ""});
}

template <class A, class B>
std::string message_of(A left, B right) {
  return failure_of([&] { HS_CHECK_OP(left, ==, right); }).what();
}

TEST_F(CheckHandlerTest, HandlerReceivesLocationAndMessage) {
  const int width = 3;
  const CheckFailed f = failure_of([&] { HS_CHECK_OP(width % 2, ==, 0); });
  EXPECT_EQ(f.line, __LINE__ - 1);
  EXPECT_EQ(f.file, __FILE__);
  EXPECT_STREQ(f.what(), "width % 2 == 0 (1 vs 0)");
  EXPECT_STREQ(failure_of([&] { HS_CHECK(width > 3); }).what(), "width > 3");
  EXPECT_EQ(f.thread, std::this_thread::get_id());
  HS_CHECK(width == 3);
  HS_CHECK_OP(width, >, 2);
  EXPECT_EQ(handler_calls, 2);
}

TEST_F(CheckHandlerTest, MessageIsInWordsIfTheCheckHasThem) {
  const int width = 3;
  EXPECT_STREQ(failure_of([&] { HS_CHECK(width > 3, "map: too narrow; expected more"); }).what(), "map: too narrow; expected more");
  EXPECT_STREQ(failure_of([&] { HS_CHECK_OP(width, >, 4, "map: too narrow; expected more"); }).what(),
               "map: too narrow; expected more (3 vs 4)");
}

TEST_F(CheckHandlerTest, MessageShowsValuesOfEveryArithmeticType) {
  const std::string prefix = "left == right ";
  EXPECT_EQ(message_of(-7, 8), prefix + "(-7 vs 8)");
  EXPECT_EQ(message_of(std::numeric_limits<int64_t>::min(), int64_t{0}), prefix + "(-9223372036854775808 vs 0)");
  EXPECT_EQ(message_of(std::numeric_limits<uint64_t>::max(), std::size_t{0}), prefix + "(18446744073709551615 vs 0)");
  EXPECT_EQ(message_of(uint8_t{65}, uint8_t{66}), prefix + "(65 vs 66)");
  EXPECT_EQ(message_of(true, false), prefix + "(1 vs 0)");
  EXPECT_EQ(message_of(0.1f, 2.5), prefix + "(0.1 vs 2.5)");
  EXPECT_EQ(message_of(3.14159265, 1e20), prefix + "(3.14159 vs 1e+20)");
  EXPECT_EQ(message_of(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()), prefix + "(-inf vs nan)");
}

TEST_F(CheckHandlerTest, SetReturnsThePreviousHandler) {
  EXPECT_EQ(set_check_handler(return_from_failure), throw_failure);
  EXPECT_EQ(set_check_handler(nullptr), return_from_failure);
  EXPECT_EQ(set_check_handler(throw_failure), nullptr);
}

/// Tests how a check that fails inside a task is reported to the calling thread.
class TaskCheckTest : public CheckHandlerTest, public testing::WithParamInterface<int> {
 protected:
  const Workers workers_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Threads, TaskCheckTest, testing::Values(1, 2, 7));

TEST_P(TaskCheckTest, FailureReachesTheCallingThread) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> running = 0;
  std::atomic<bool> has_failed = false;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  // With several threads, only a thread other than the caller's fails the check; the caller's tasks wait for that.
  const auto task = [&](int i) {
    struct Running {
      explicit Running(std::atomic<int>& n) : count(n) { ++count; }
      ~Running() { --count; }
      std::atomic<int>& count;
    } const counted(running);
    if (workers_.threads() == 1 || std::this_thread::get_id() != caller) {
      has_failed = true;
      HS_CHECK_OP(i, <, 0);
    }
    while (!has_failed && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  };
  const CheckFailed f = failure_of([&] { workers_.for_each(100, task); });
  EXPECT_EQ(f.thread, caller);
  EXPECT_EQ(running, 0);
  EXPECT_EQ(handler_calls, 1);
  EXPECT_EQ(std::string(f.what()).find("i < 0 ("), 0u) << f.what();

  // The pool stays usable, and checks outside of tasks call the handler immediately.
  std::atomic<int> done = 0;
  workers_.for_each(100, [&](int) { ++done; });
  EXPECT_EQ(done, 100);
  EXPECT_STREQ(failure_of([] { HS_CHECK(1 + 1 == 3); }).what(), "1 + 1 == 3");
}

TEST_P(TaskCheckTest, FailurePropagatesThroughNestedTasks) {
  std::atomic<int> handled_inside = 0;
  const CheckFailed f = failure_of([&] {
    workers_.for_each(4, [&](int i) {
      try {
        workers_.for_each(4, [&](int j) { HS_CHECK_OP(i + j, <, 3); });
      } catch (const std::exception&) {
        ++handled_inside;
      }
    });
  });
  EXPECT_EQ(f.thread, std::this_thread::get_id());
  EXPECT_EQ(handled_inside, 0);
  EXPECT_EQ(handler_calls, 1);
}

TEST_P(TaskCheckTest, OtherExceptionsPropagateUnchanged) {
  const auto task = [](int i) {
    if (i == 50) throw InputError("line 50");
  };
  EXPECT_THROW(workers_.for_each(100, task), InputError);
  EXPECT_EQ(handler_calls, 0);
}

// ---- failures that abort ---------------------------------------------------------------------------------------

class CheckDeathTest : public CheckHandlerTest {
 protected:
  // A forked child has no worker threads, so death tests re-execute the program instead.
  CheckDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  ~CheckDeathTest() override { GTEST_FLAG_SET(death_test_style, "fast"); }
};

TEST_F(CheckDeathTest, PrintsAndAbortsWithoutAHandler) {
  set_check_handler(nullptr);
  const int width = 3;
  EXPECT_DEATH(HS_CHECK_OP(width, <, 2), "check_test.cpp:[0-9]+: check failed: width < 2 \\(3 vs 2\\)\n");
  EXPECT_DEATH(HS_CHECK(width < 2), "check_test.cpp:[0-9]+: check failed: width < 2\n");
  for (const int threads : {1, 2, 7}) {
    const auto task = [](int i) {
      try {
        HS_CHECK_OP(i, <, 0);
      } catch (...) {
        std::_Exit(1);  // the test expects an abort at the point of failure
      }
    };
    EXPECT_DEATH(Workers(threads).for_each(100, task), "check_test.cpp:[0-9]+: check failed: i < 0 ");
  }
}

TEST_F(CheckDeathTest, AbortsWhenTheHandlerReturns) {
  set_check_handler(return_from_failure);
  EXPECT_DEATH(HS_CHECK(1 + 1 == 3), "check failed: 1 \\+ 1 == 3");
  EXPECT_DEATH(Workers(2).for_each(100, [](int i) { HS_CHECK_OP(i, <, 0); }), "check failed: i < 0 ");
}

}  // namespace
}  // namespace halfspace
