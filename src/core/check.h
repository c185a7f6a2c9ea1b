// SPDX-License-Identifier: Apache-2.0
//
// Two kinds of failure. A broken precondition is the caller's bug: HS_CHECK prints both values and aborts, in every
// build; HS_DCHECK does so in builds with asserts (inner loops). A bad file or argument is the user's: InputError.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
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

namespace detail {

/// Prints "file:line: check failed: text (left against right)" and aborts.
[[noreturn]] void check_failed(const char* file, int line, const char* text, const std::string& left, const std::string& right);

template <class A, class B>
[[noreturn]] __attribute__((noinline, cold)) void check_op_failed(const char* file, int line, const char* text, const A& a, const B& b) {
  std::ostringstream left;
  std::ostringstream right;
  left << a;
  right << b;
  check_failed(file, line, text, left.str(), right.str());
}

}  // namespace detail

}  // namespace halfspace

// These are macros because only a macro knows the text and the place of its caller.
#define HS_CHECK_OP(a, op, b) (((a)op(b)) ? (void)0 : ::halfspace::detail::check_op_failed(__FILE__, __LINE__, #a " " #op " " #b, (a), (b)))
#define HS_CHECK(condition) ((condition) ? (void)0 : ::halfspace::detail::check_failed(__FILE__, __LINE__, #condition, "", ""))
#ifdef HALFSPACE_ASSERTS
#define HS_DCHECK(condition) HS_CHECK(condition)
#else
#define HS_DCHECK(condition) ((void)sizeof(condition))
#endif
