// SPDX-License-Identifier: Apache-2.0
//
// Compares the functions and operators of the shading language with double precision (builtin_functions.h).
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "conformance/builtin_functions.h"

namespace halfspace::conformance {
namespace builtins {

void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

class BuiltinFunctions : public testing::TestWithParam<Case> {};
TEST_P(BuiltinFunctions, AreWithinTheirErrorBounds) { EXPECT_EQ(check(GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Conformance, BuiltinFunctions, testing::ValuesIn(all_cases()), [](const auto& test) { return test.param.name; });

TEST(BuiltinFunctionCases, CoverTheFunctionsOfTheReference) {
  std::ifstream file("docs/reference/shading_language.md");
  ASSERT_TRUE(file) << "docs/reference/shading_language.md not found; run the test from the root of the source tree";
  const std::regex call(R"((\w+)\()");
  std::set<std::string> called;
  for (const Case& c : all_cases()) {
    for (std::sregex_iterator i(c.glsl.begin(), c.glsl.end(), call), end; i != end; ++i) called.insert((*i)[1]);
  }
  const std::regex row(R"(\| `(\w+)` \| 8\.\d .*\|.*)");
  int functions = 0;
  for (std::string line; std::getline(file, line) && line != "## Absent";) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    ++functions;
    EXPECT_TRUE(called.contains(match[1])) << match[1];
  }
  EXPECT_GE(functions, 85);
}

}  // namespace builtins
}  // namespace halfspace::conformance
