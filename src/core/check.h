// SPDX-License-Identifier: Apache-2.0
//
// Two kinds of failure. A broken precondition is a bug in the caller: HS_CHECK reports it in every build, and HS_DCHECK (for inner loops)
// only in builds with assertions. An invalid file or argument is a user error and throws InputError.
//
// A failed check prints one line and aborts, unless the host program has set a check handler. A handler may throw, so that the host program
// keeps running:
//
//   set_check_handler([](const CheckFailure& failure) { throw std::logic_error(failure.message); });
//
// After such an exception, an object that the failed call was modifying may only be destroyed. This applies to a Pass if the exception left
// its draw() or run().
#pragma once

#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Thrown for invalid user input. what() is a single line that names the place, the problem and what was expected.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown when a result cannot be written. what() is a single line that names the path and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Describes a failed check: its source location, and a one-line message: the problem in words or, for internal checks, the condition. For
/// comparisons the message ends with both values, for example "width % 2 == 0 (1 vs 0)".
struct CheckFailure {
  const char* file;
  int line;
  std::string message;
};

/// Called when a check fails, on the thread that called the library. A handler may throw. If it returns, the failure is
/// printed and the program aborts.
using CheckHandler = void (*)(const CheckFailure& failure);

/// Sets the handler for the whole process and returns the previous one. With a null handler, which is the default, a failed check prints
/// and aborts immediately, so that a debugger shows the call stack of the check.
///
/// When a handler is set, a check that fails in a task of Workers::for_each ends the task with an internal exception. for_each then calls
/// the handler on its calling thread once all tasks have stopped. If a check fails in a noexcept function, or where the host does not allow
/// exceptions, std::terminate is called.
///
/// Safe to call from any thread at any time. If several threads call the library concurrently, the handler may be called concurrently as
/// well.
CheckHandler set_check_handler(CheckHandler handler) noexcept;

namespace detail {

/// Reports a failed check. Calls the handler, or leaves that to for_each if a task is running on this thread.
[[noreturn]] __attribute__((cold)) void check_failed(const char* file, int line, const char* condition);
[[noreturn]] __attribute__((cold)) void check_failed(const char* file, int line, const char* condition, const std::string& left,
                                                     const std::string& right);

/// Returns the message of a check: its words if it has any, otherwise its condition.
constexpr const char* check_text(const char* condition, const char* words = nullptr) { return words != nullptr ? words : condition; }

std::string value_text(int64_t value);
std::string value_text(uint64_t value);
std::string value_text(double value);  ///< six significant digits, like %g

template <class T>
std::string any_value_text(T value) {
  if constexpr (std::floating_point<T>) {
    return value_text(static_cast<double>(value));
  } else if constexpr (std::signed_integral<T>) {
    return value_text(int64_t{value});
  } else {
    return value_text(uint64_t{value});
  }
}

template <class A, class B>
[[noreturn]] __attribute__((noinline, cold)) void comparison_failed(const char* file, int line, const char* condition, A left, B right) {
  check_failed(file, line, condition, any_value_text(left), any_value_text(right));
}

}  // namespace detail

}  // namespace halfspace::HS_LANES

// These are macros because they need the text of the condition and the location of the caller. A check that passes costs
// one comparison; failure handling is out of line. Checks that a caller of the public API can fail have a second argument: the
// message in words, "PLACE: problem; expected ...". Without it, for internal checks, the message is the text of the condition.
#define HS_CHECK_OP(a, op, b, ...)                      \
  (((a)op(b)) ? (void)0                                 \
              : ::halfspace::detail::comparison_failed( \
                    __FILE__, __LINE__, ::halfspace::detail::check_text(#a " " #op " " #b __VA_OPT__(, ) __VA_ARGS__), (a), (b)))
#define HS_CHECK(condition, ...) \
  ((condition)                   \
       ? (void)0                 \
       : ::halfspace::detail::check_failed(__FILE__, __LINE__, ::halfspace::detail::check_text(#condition __VA_OPT__(, ) __VA_ARGS__)))
#ifdef HALFSPACE_ASSERTS
#define HS_DCHECK(condition) HS_CHECK(condition)
#else
#define HS_DCHECK(condition) ((void)sizeof(condition))
#endif
