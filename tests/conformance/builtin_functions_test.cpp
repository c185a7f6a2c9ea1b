// SPDX-License-Identifier: Apache-2.0
//
// Compares the functions and operators of the shading language with double precision (builtin_functions.h).
#include <gtest/gtest.h>

#include "conformance/builtin_functions.h"

namespace halfspace::conformance {
namespace builtins {

void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

class BuiltinFunctions : public testing::TestWithParam<Case> {};
TEST_P(BuiltinFunctions, AreWithinTheirErrorBounds) { EXPECT_EQ(check(GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Conformance, BuiltinFunctions, testing::ValuesIn(all_cases()), [](const auto& test) { return test.param.name; });

}  // namespace builtins
}  // namespace halfspace::conformance
