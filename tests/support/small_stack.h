// SPDX-License-Identifier: Apache-2.0
//
// Runs code with a small stack, such as musl's 128 KiB.
#pragma once

#include <pthread.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <utility>

namespace halfspace {

inline constexpr std::size_t kSmallStack = std::size_t{128} << 10;

/// Calls function on a thread with a stack of kSmallStack bytes. While it runs, new std::threads have the same stack size. A stack overflow
/// terminates the program, because the 16 MiB below each stack are inaccessible. Exceptions are rethrown.
template <class F>
void on_small_stack(F&& function) {
  constexpr std::size_t kGuard = std::size_t{16} << 20;
  const auto expect_zero = [](int error) {
    if (error != 0) throw std::runtime_error("cannot create a thread with a small stack");
  };
  pthread_attr_t usual, small;
  expect_zero(pthread_getattr_default_np(&usual));
  expect_zero(pthread_attr_init(&small));
  expect_zero(pthread_attr_setstacksize(&small, kSmallStack));
  expect_zero(pthread_attr_setguardsize(&small, kGuard));
  expect_zero(pthread_setattr_default_np(&small));

  struct Call {
    F& function;
    std::exception_ptr error;
  } call{function, nullptr};
  const auto run = [](void* argument) -> void* {
    Call& c = *static_cast<Call*>(argument);
    try {
      c.function();
    } catch (...) {
      c.error = std::current_exception();
    }
    return nullptr;
  };
  pthread_t thread;
  expect_zero(pthread_create(&thread, &small, run, &call));
  expect_zero(pthread_join(thread, nullptr));

  expect_zero(pthread_setattr_default_np(&usual));
  pthread_attr_destroy(&small);
  pthread_attr_destroy(&usual);
  if (call.error) std::rethrow_exception(call.error);
}

}  // namespace halfspace
