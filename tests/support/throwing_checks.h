// SPDX-License-Identifier: Apache-2.0
//
// For tests of misuse: while one of them runs, a failed check throws an exception instead of ending the process.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "halfspace/core/check.h"

namespace halfspace {

class ThrowingChecksTest : public testing::Test {
 protected:
  ThrowingChecksTest() {
    set_check_handler([](const CheckFailure& f) { throw std::logic_error(f.message); });
  }
  ~ThrowingChecksTest() override { set_check_handler(nullptr); }
};

/// Returns the message of the check that failed in `function`, or "" if none failed. Call it in a ThrowingChecksTest.
template <class F>
std::string failure_of(const F& function) {
  try {
    function();
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "";
}

}  // namespace halfspace
