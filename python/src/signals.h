// SPDX-License-Identifier: Apache-2.0
//
// Lets Python handle signals while this module computes without the GIL.
#pragma once

namespace halfspace::python {

/// Runs Python's signal handlers if signals have arrived, at most every 50 ms and only on the main thread of the process; otherwise does
/// nothing. Throws the exception that a handler raises, such as KeyboardInterrupt. Workers call this function before each task. The caller
/// may hold a SceneMutex, but no other lock that Python code can wait for.
void check_signals();

}  // namespace halfspace::python
