// SPDX-License-Identifier: Apache-2.0
//
// Compares blits and resolves with OpenGL 4.6 in double precision (blits.h).
#include <gtest/gtest.h>

#include "conformance/blits.h"

namespace halfspace::conformance {
namespace blits {

void PrintTo(const BlitCase& c, std::ostream* os) { *os << c.name; }

class FramebufferBlit : public testing::TestWithParam<BlitCase> {};
TEST_P(FramebufferBlit, CopiesWhatTheSpecificationDefines) { EXPECT_EQ(check(GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Conformance, FramebufferBlit, testing::ValuesIn(blit_cases()), [](const auto& test) { return test.param.name; });

}  // namespace blits
}  // namespace halfspace::conformance
