// SPDX-License-Identifier: Apache-2.0
//
// Checks that docs/results/conformance.md contains the current number of cases per group, and that each group has enough of them. A dash in
// place of the number of CTS cases means that the number is not known.
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

TEST(ConformanceDocument, HasTheCurrentCounts) {
  std::ifstream file("docs/results/conformance.md");
  ASSERT_TRUE(file) << "docs/results/conformance.md not found; run the test from the root of the source tree";
  const std::regex row(R"(\| [^|]+ \| (\d+|–) \| `(\w+)` \| (\d+) \|.*)");
  std::map<std::string, int> registered = registered_sets();
  int sum = 0;
  for (std::string line; std::getline(file, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const int there = match[1] == "–" ? 0 : std::stoi(match[1]), here = std::stoi(match[3]);
    const std::string suite = match[2];
    EXPECT_EQ(here, registered[suite]) << "docs/results/conformance.md, " << suite;
    EXPECT_GE(here * 4, there) << suite << ": fewer than a quarter of the cases in VK-GL-CTS";
    EXPECT_GE(here, 10) << suite;
    sum += here;
    registered.erase(suite);
  }
  EXPECT_GE(sum, 2400);
  EXPECT_TRUE(registered.empty()) << registered.begin()->first << " has no row in docs/results/conformance.md";
}

}  // namespace halfspace::conformance
