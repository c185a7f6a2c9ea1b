// SPDX-License-Identifier: Apache-2.0
//
// The prediction of times with more threads, on schedules that can be computed by hand.
#include "runner/scaling.h"

#include <gtest/gtest.h>

#include <chrono>
#include <span>
#include <thread>

#include "halfspace/core/parallel.h"

namespace halfspace {
namespace {

const TaskLog kLog{
    .phases = {{.serial_ms = 1, .tasks_ms = {4, 2, 2, 4}}, {.serial_ms = 2, .tasks_ms = {3}}, {.serial_ms = 0, .tasks_ms = {}}},
    .last_serial_ms = 5};

double scheduled(int workers) { return scheduled_ms(std::span(&kLog, 1), workers); }

TEST(Scaling, SchedulesTasksInOrder) {
  EXPECT_DOUBLE_EQ(scheduled(1), 1 + 12 + 2 + 3 + 5);
  // Worker 1: 4, then 4; worker 2: 2, 2, then idle.
  EXPECT_DOUBLE_EQ(scheduled(2), 1 + 8 + 2 + 3 + 5);
  EXPECT_DOUBLE_EQ(scheduled(3), 1 + 6 + 2 + 3 + 5);
  EXPECT_DOUBLE_EQ(scheduled(4), 1 + 4 + 2 + 3 + 5);
  EXPECT_DOUBLE_EQ(scheduled(128), 1 + 4 + 2 + 3 + 5);
}

TEST(Scaling, WorkersHaveTheSpeedsOfTheirCpus) {
  TaskLog slow = kLog;
  slow.phases[0].tasks_ms = {8, 4, 4, 8};
  slow.phases[1].serial_ms = 4;
  const TaskLog logs[] = {kLog, slow};
  // The fast worker: 4, then 2. The slow one: 4, then 8, because it is free first.
  EXPECT_DOUBLE_EQ(scheduled_ms(logs, 2), 1 + 12 + 3 + 3 + 5);
}

TEST(Scaling, PhasesWithOneTaskAreSerial) { EXPECT_DOUBLE_EQ(serial_ms(kLog), 1 + 2 + 3 + 5); }

void wait(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// Lower bounds are exact, because a sleep never ends early. The upper bounds allow for a busy machine.
TEST(Scaling, RecordsPhasesAndTasks) {
  const Workers workers(1);
  TaskLog log;
  {
    const TaskRecording recording(log);
    wait(5);
    workers.for_each(3, [&](int i) {
      wait(2 + i);
      workers.for_each(2, [](int) { wait(1); });  // part of the task
    });
    workers.for_each(0, [](int) {});
    wait(3);
  }
  workers.for_each(1, [](int) {});  // after the recording
  ASSERT_EQ(log.phases.size(), 2u);
  ASSERT_EQ(log.phases[0].tasks_ms.size(), 3u);
  EXPECT_GE(log.phases[0].serial_ms, 5.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(log.phases[0].tasks_ms[i], 4.0 + static_cast<double>(i));
    EXPECT_LT(log.phases[0].tasks_ms[i], 1000.0);
  }
  EXPECT_TRUE(log.phases[1].tasks_ms.empty());
  EXPECT_GE(log.last_serial_ms, 3.0);
}

// A team of any size is recorded by one thread, because tasks that run at the same time would disturb each other.
TEST(Scaling, OneThreadRunsTheTasksOfATeam) {
  for (const int threads : {2, 64}) {
    const Workers workers(threads);
    TaskLog log;
    {
      const TaskRecording recording(log);
      workers.for_each(100, [self = std::this_thread::get_id()](int) { EXPECT_EQ(std::this_thread::get_id(), self); });
    }
    ASSERT_EQ(log.phases.size(), 1u);
    EXPECT_EQ(log.phases[0].tasks_ms.size(), 100u);
  }
}

TEST(Scaling, OtherThreadsAreNotRecorded) {
  TaskLog log;
  const TaskRecording recording(log);
  std::thread([] { Workers(1).for_each(3, [](int) {}); }).join();
  EXPECT_TRUE(log.phases.empty());
}

TEST(Scaling, ATaskThatThrowsEndsItsPhase) {
  TaskLog log;
  {
    const TaskRecording recording(log);
    EXPECT_THROW(Workers(1).for_each(3, [](int) { throw 1; }), int);
    Workers(1).for_each(1, [](int) {});
  }
  EXPECT_EQ(log.phases.size(), 2u);
}

}  // namespace
}  // namespace halfspace
