// SPDX-License-Identifier: Apache-2.0
//
// Failed checks: the message, the handler, and the way from a task to the thread that waits for it (check.h, task_check.h).
#include "halfspace/core/check.h"

#include <array>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "halfspace/core/task_check.h"

namespace halfspace::HS_LANES {

namespace {

std::atomic<CheckHandler> check_handler = nullptr;
thread_local bool is_in_task = false;

[[noreturn]] void print_and_abort(const CheckFailure& failure) {
  std::fprintf(stderr, "%s:%d: check failed: %s\n", failure.file, failure.line, failure.message.c_str());
  std::abort();
}

[[noreturn]] void report(CheckFailure failure) {
  const CheckHandler handler = check_handler.load();
  if (handler != nullptr) {
    if (is_in_task) throw detail::TaskCheckFailure{std::move(failure)};
    handler(failure);
  }
  print_and_abort(failure);
}

template <class T, class... Format>
std::string characters(T value, Format... format) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format...).ptr};
}

}  // namespace

CheckHandler set_check_handler(CheckHandler handler) noexcept { return check_handler.exchange(handler); }

namespace detail {

void check_failed(const char* file, int line, const char* condition) { report({file, line, condition}); }

void check_failed(const char* file, int line, const char* condition, const std::string& left, const std::string& right) {
  report({file, line, std::string(condition) + " (" + left + " vs " + right + ")"});
}

std::string value_text(int64_t value) { return characters(value); }
std::string value_text(uint64_t value) { return characters(value); }
std::string value_text(double value) { return characters(value, std::chars_format::general, 6); }

TaskScope::TaskScope() : outer_(std::exchange(is_in_task, true)) {}
TaskScope::~TaskScope() { is_in_task = outer_; }

void report_from_task(const TaskCheckFailure& failure) { report(failure.failure); }

}  // namespace detail

}  // namespace halfspace::HS_LANES
