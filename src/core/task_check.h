// SPDX-License-Identifier: Apache-2.0
//
// How a check that fails in a task reaches the thread that called Workers::for_each. For parallel.cpp only.
#pragma once

#include "halfspace/core/check.h"

namespace halfspace::detail {

/// Thrown by a check that fails in a task while a handler is set. It is no std::exception, so that a task that catches
/// those does not take it for one of its own errors.
struct TaskCheckFailure {
  CheckFailure failure;
};

/// While it lives, a task runs on this thread. Scopes may be nested.
class TaskScope {
 public:
  TaskScope();
  ~TaskScope();
  TaskScope(const TaskScope&) = delete;
  TaskScope& operator=(const TaskScope&) = delete;

 private:
  bool outer_;
};

/// Reports a failure that was caught after the tasks had ended: to the enclosing task if there is one, else to the
/// handler.
[[noreturn]] void report_from_task(const TaskCheckFailure& failure);

}  // namespace halfspace::detail
