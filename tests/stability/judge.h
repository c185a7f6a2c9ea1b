// SPDX-License-Identifier: Apache-2.0
//
// Where methods fail: each test holds the plain method, in the regime where it is known to fail, beside ours. The numbers go into
// the test's report, from which scripts/stability_table.py makes docs/explanation/stability.md.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace halfspace::stability {

/// What a test is about. Rows are those of the table, 1 to 28; a row may have several tests.
struct Regime {
  int row;
  const char* failure;  ///< what goes wrong
  const char* regime;   ///< where, and which the two methods are
  const char* number;   ///< what is counted; 0 is right
};

/// Notes the numbers, and asserts that the plain method is at least as wrong as `bad` (so the test looks in the right place) and
/// ours at most `bound`.
inline void judge(const Regime& r, double plain, double bad, double ours, double bound) {
  const auto text = [](double x) {
    char out[32];
    std::snprintf(out, sizeof out, "%.3g", x);
    return std::string(out);
  };
  using testing::Test;
  Test::RecordProperty("row", r.row);
  Test::RecordProperty("failure", r.failure);
  Test::RecordProperty("regime", r.regime);
  Test::RecordProperty("number", r.number);
  Test::RecordProperty("plain", text(plain));
  Test::RecordProperty("ours", text(ours));
  Test::RecordProperty("bound", text(bound));
  EXPECT_GE(plain, bad) << "the plain method is not wrong here: this is not the regime";
  EXPECT_LE(ours, bound) << r.failure << ": " << r.regime;
}

}  // namespace halfspace::stability
