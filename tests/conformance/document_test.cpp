// SPDX-License-Identifier: Apache-2.0
//
// docs/conformance.md holds the counts of the sets that are registered, and they are enough.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

namespace halfspace::conformance {

namespace {

std::map<std::string, int> registered_sets() {
  std::map<std::string, int> sets;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    const std::string name = suite.name(), prefix = "Conformance/";
    if (name.rfind(prefix, 0) == 0) sets[name.substr(prefix.size())] = suite.total_test_count();
  }
  return sets;
}

}  // namespace

TEST(ConformanceDocument, CountsTheSets) {
  std::ifstream file("docs/conformance.md");
  ASSERT_TRUE(file) << "docs/conformance.md is missing: run from the root of the tree";
  const std::regex row(R"(\| [^|]+ \| (\d+) \| `(\w+)` \| (\d+) \|.*)");
  std::map<std::string, int> registered = registered_sets();
  int sum = 0;
  for (std::string line; std::getline(file, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const int there = std::stoi(match[1]), here = std::stoi(match[3]);
    const std::string suite = match[2];
    EXPECT_EQ(here, registered[suite]) << "docs/conformance.md, " << suite;
    EXPECT_GE(here * 4, there) << suite << ": fewer than a quarter of the cases there";
    EXPECT_GE(here, 10) << suite;
    sum += here;
    registered.erase(suite);
  }
  EXPECT_GE(sum, 600);
  EXPECT_TRUE(registered.empty()) << registered.begin()->first << " has no row in docs/conformance.md";
}

}  // namespace halfspace::conformance
