// SPDX-License-Identifier: Apache-2.0
//
// Forwards a check that fails in a task to the thread that called Workers::for_each. Used by parallel.cpp and check_handler.cpp only.
#pragma once

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES::detail {

/// Thrown by a check that fails in a task while a handler is set. It does not derive from std::exception, so that a task that
/// catches its own exceptions does not swallow it.
struct TaskCheckFailure {
  CheckFailure failure;
};

/// While a TaskScope exists, its thread is marked as running a task. Scopes can be nested.
class TaskScope {
 public:
  TaskScope();
  ~TaskScope();
  TaskScope(const TaskScope&) = delete;
  TaskScope& operator=(const TaskScope&) = delete;

 private:
  bool outer_;
};

/// Reports a failure that was caught after the tasks ended, to the enclosing task if there is one and otherwise to the handler.
[[noreturn]] void report_from_task(const TaskCheckFailure& failure);

}  // namespace halfspace::HS_LANES::detail
