// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <chrono>

namespace halfspace::python {

namespace {

// Python runs signal handlers on its main thread only. Other threads do not wait for the GIL.
bool is_main_thread() { return ::gettid() == ::getpid(); }

}  // namespace

void check_signals() {
  using Clock = std::chrono::steady_clock;
  thread_local Clock::time_point next{};
  const Clock::time_point now = Clock::now();
  if (now < next) return;
  next = now + std::chrono::milliseconds(50);  // waiting for the GIL can take 5 ms if other threads run Python code
  if (!is_main_thread()) return;
  const pybind11::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

}  // namespace halfspace::python
