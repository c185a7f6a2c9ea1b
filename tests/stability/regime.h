// SPDX-License-Identifier: Apache-2.0
//
// Known failure modes of renderers. Each test runs the common method under conditions in which it is known to fail, and then our method for
// comparison. The results are recorded in the test report, from which scripts/docs/stability_table.py generates
// docs/explanation/stability.md.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace halfspace::stability {

/// The subject of a test. Rows are numbered as in the table, 1 to 34; a row can have several tests.
struct Regime {
  int row;
  const char* failure;  ///< what goes wrong
  const char* regime;   ///< the conditions, and the two methods: "CONDITIONS; COMMON METHOD vs. OURS"
  const char* number;   ///< what is measured; 0 is correct
};

/// Records the results. Asserts that the error of the common method is at least `bad`, so that the test really covers a failure, and that
/// the error of our method is at most `bound`.
inline void record_and_check(const Regime& r, double common, double bad, double ours, double bound) {
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
  Test::RecordProperty("common", text(common));
  Test::RecordProperty("ours", text(ours));
  Test::RecordProperty("bound", text(bound));
  EXPECT_GE(common, bad) << "the common method does not fail here, so the test does not cover the failure";
  EXPECT_LE(ours, bound) << r.failure << ": " << r.regime;
}

}  // namespace halfspace::stability
