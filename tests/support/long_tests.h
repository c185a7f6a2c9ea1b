// SPDX-License-Identifier: Apache-2.0
//
// Controls how much work is done by tests that draw random cases or read many files. scripts/test_full.sh sets HALFSPACE_LONG_TESTS.
#pragma once

#include <cstdlib>

namespace halfspace {

/// Returns whether tests run in full length.
inline bool runs_long_tests() { return std::getenv("HALFSPACE_LONG_TESTS") != nullptr; }

}  // namespace halfspace
