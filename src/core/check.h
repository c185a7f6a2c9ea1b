// SPDX-License-Identifier: Apache-2.0
//
// Two kinds of failure. A broken precondition is the caller's mistake: HS_CHECK reports it in every build, HS_DCHECK in
// builds with asserts (inner loops). A bad file or argument is the user's: InputError.
//
// A failed check prints one line and aborts, unless the host program has set a check handler. A handler may throw, so
// that the host survives the mistake:
//
//   set_check_handler([](const CheckFailure& failure) { throw std::logic_error(failure.message); });
//
// After such an exception, objects that the failed call was changing may only be destroyed. This holds for a Pass whose
// draw() or run() ended this way.
#pragma once

#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace halfspace {

/// Untrusted input that cannot be used. what() is one line: where, what is wrong, what would be right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A result that cannot be written. what() is one line: the path, and why.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A failed check: the place in the source and one line with the condition and, of a comparison, both values,
/// for example "width % 2 == 0 (1 against 0)".
struct CheckFailure {
  const char* file;
  int line;
  std::string message;
};

/// Called when a check fails. It runs on the thread that called the library and may throw; if it returns, the failure
/// is printed and the program aborts.
using CheckHandler = void (*)(const CheckFailure& failure);

/// Sets the handler of the whole process and returns the previous one. Null, the default, prints and aborts on the
/// spot, so that a debugger shows the stack of the failed check.
///
/// With a handler, a check that fails in a task of Workers::for_each ends the task by an internal exception; for_each
/// calls the handler on its own calling thread once no task is running. A check that fails in a noexcept function, or
/// where the host forbids exceptions, ends in std::terminate.
///
/// May be called from any thread at any time. Threads that call the library at the same time may call the handler at
/// the same time.
CheckHandler set_check_handler(CheckHandler handler) noexcept;

namespace detail {

/// Reports a failed check: calls the handler, or leaves that to for_each when a task runs on this thread.
[[noreturn]] __attribute__((cold)) void check_failed(const char* file, int line, const char* condition);
[[noreturn]] __attribute__((cold)) void check_failed(const char* file, int line, const char* condition, const std::string& left,
                                                     const std::string& right);

std::string value_text(int64_t value);
std::string value_text(uint64_t value);
std::string value_text(double value);  ///< six digits, as %g

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

}  // namespace halfspace

// These are macros because only a macro knows the text and the place of its caller. A check that passes costs one
// comparison; what follows a failure is out of line.
#define HS_CHECK_OP(a, op, b) \
  (((a)op(b)) ? (void)0 : ::halfspace::detail::comparison_failed(__FILE__, __LINE__, #a " " #op " " #b, (a), (b)))
#define HS_CHECK(condition) ((condition) ? (void)0 : ::halfspace::detail::check_failed(__FILE__, __LINE__, #condition))
#ifdef HALFSPACE_ASSERTS
#define HS_DCHECK(condition) HS_CHECK(condition)
#else
#define HS_DCHECK(condition) ((void)sizeof(condition))
#endif
