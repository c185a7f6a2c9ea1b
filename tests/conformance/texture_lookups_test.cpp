// SPDX-License-Identifier: Apache-2.0
//
// Compares the lookups of TextureView in textures of every kind and format with OpenGL 4.6 in double precision (texture_lookups.h).
#include <gtest/gtest.h>

#include "conformance/texture_lookups.h"
#include "support/long_tests.h"

namespace halfspace::conformance {
namespace lookups {

void PrintTo(const LookupCase& c, std::ostream* os) { *os << c.name; }

namespace {

class LookupsOf : public testing::TestWithParam<LookupCase> {
 protected:
  static void expect_no_error() { EXPECT_EQ(check(GetParam()), ""); }
};
const auto lookup_name = [](const auto& test) { return test.param.name; };

}  // namespace

class TextureFormats : public LookupsOf {};
TEST_P(TextureFormats, AreDecodedBeforeTheyAreFiltered) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureFormats, testing::ValuesIn(format_cases()), lookup_name);

class TextureKinds : public LookupsOf {};
TEST_P(TextureKinds, AreFilteredByTheSpecification) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureKinds, testing::ValuesIn(kind_cases()), lookup_name);

class TextureWrap : public LookupsOf {};
TEST_P(TextureWrap, SelectsTexelsBeyondTheEdges) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureWrap, testing::ValuesIn(wrap_cases()), lookup_name);

class TextureShadow : public LookupsOf {};
TEST_P(TextureShadow, FiltersComparisons) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureShadow, testing::ValuesIn(shadow_cases()), lookup_name);

class TextureGather : public LookupsOf {};
TEST_P(TextureGather, ReturnsTheFourTexelsOfALinearFilter) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureGather, testing::ValuesIn(gather_cases()), lookup_name);

class TextureFunctions : public LookupsOf {};
TEST_P(TextureFunctions, ReturnWhatGlslDefines) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureFunctions, testing::ValuesIn(function_cases()), lookup_name);

class TextureSwizzle : public LookupsOf {};
TEST_P(TextureSwizzle, SelectsChannels) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureSwizzle, testing::ValuesIn(swizzle_cases()), lookup_name);

class TextureLevels : public LookupsOf {};
TEST_P(TextureLevels, FollowBiasAndLimits) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureLevels, testing::ValuesIn(level_cases()), lookup_name);

class TextureMultisample : public LookupsOf {};
TEST_P(TextureMultisample, FetchesEachSample) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureMultisample, testing::ValuesIn(multisample_cases()), lookup_name);

TEST(ConformanceRandomLookups, MatchTheReference) {
  for (unsigned seed = 0; seed < (runs_long_tests() ? 50000u : 2000u); ++seed) {
    const LookupCase c = random_case(seed);
    ASSERT_EQ(check(c), "") << c.name << ": kind " << static_cast<int>(c.kind) << ", " << texel_info(c.format).name << ", function "
                            << static_cast<int>(c.function) << ", " << c.size.width << " x " << c.size.height << " x " << c.size.depth;
  }
}

}  // namespace lookups
}  // namespace halfspace::conformance
