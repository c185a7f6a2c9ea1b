// SPDX-License-Identifier: Apache-2.0
//
// Checks that docs/explanation/stability.md is complete: it contains rows 1 to 34, every test that it names exists, and every test is
// listed.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace halfspace::stability {
namespace {

TEST(StabilityTable, HasEveryRowAndTest) {
  std::ifstream file("docs/explanation/stability.md");  // tests run from the source tree
  ASSERT_TRUE(file) << "docs/explanation/stability.md is missing; scripts/docs/stability_table.py generates it";
  std::set<int> rows;
  std::set<std::string> named;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ") || line.find("`Stability.") == std::string::npos) continue;
    rows.insert(std::atoi(line.c_str() + 2));
    const std::size_t at = line.find("`Stability.") + 11;
    named.insert(line.substr(at, line.find('`', at) - at));
  }
  for (int row = 1; row <= 34; ++row) EXPECT_TRUE(rows.contains(row)) << "row " << row << " is missing";
  std::set<std::string> tests;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; std::string(suite.name()) == "Stability" && t < suite.total_test_count(); ++t)
      tests.insert(suite.GetTestInfo(t)->name());
  }
  EXPECT_EQ(named, tests) << "to update the table, run: scripts/docs/stability_table.py build/release/bin/test-stability";
}

}  // namespace
}  // namespace halfspace::stability
