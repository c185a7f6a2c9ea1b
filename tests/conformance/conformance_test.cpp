// SPDX-License-Identifier: Apache-2.0
//
// Every set of parameters of every group (groups.h) drawn by the tile path: against the oracle byte for byte, and against its closed form
// where it has one. docs/conformance.md says what each group asks.
#include <gtest/gtest.h>

#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

class ConformanceOf : public testing::TestWithParam<Case> {
 protected:
  static void expect_right() {
    const std::string wrong = check(GetParam());
    EXPECT_EQ(wrong, "");
  }
};
const auto case_name = [](const auto& test) { return test.param.name; };

}  // namespace

void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

class FillRules : public ConformanceOf {};
TEST_P(FillRules, CoverEachSampleOnce) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, FillRules, testing::ValuesIn(fill_rules_cases()), case_name);

class Primitives : public ConformanceOf {};
TEST_P(Primitives, CoverWhatTheyShould) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Primitives, testing::ValuesIn(primitives_cases()), case_name);

class Interpolation : public ConformanceOf {};
TEST_P(Interpolation, IsThatOfTheVertices) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Interpolation, testing::ValuesIn(interpolation_cases()), case_name);

class Culling : public ConformanceOf {};
TEST_P(Culling, DropsTheFace) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Culling, testing::ValuesIn(culling_cases()), case_name);

class FlatShading : public ConformanceOf {};
TEST_P(FlatShading, ShowsTheProvokingVertex) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, FlatShading, testing::ValuesIn(flatshading_cases()), case_name);

class Clipping : public ConformanceOf {};
TEST_P(Clipping, ChangesNothingInside) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Clipping, testing::ValuesIn(clipping_cases()), case_name);

class Blend : public ConformanceOf {};
TEST_P(Blend, IsTheFormula) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Blend, testing::ValuesIn(blend_cases()), case_name);

// A second source needs a second colour, whichever factor asks for it.
TEST(ConformanceBlendDeathTest, ASecondSourceNeedsASecondColor) {
  Picture p;
  p.draws.resize(1);
  p.draws[0].vertices.resize(3, {glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
  const auto draw_with = [&](auto change) {
    p.draws[0].state.blend.emplace();
    change(*p.draws[0].state.blend);
    draw(p);
  };
  constexpr BlendFactor kSecond = BlendFactor::src1_alpha;
  EXPECT_DEATH(draw_with([](BlendState& b) { b.source_color = kSecond; }), "color_count > 1");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.destination_color = kSecond; }), "color_count > 1");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.source_alpha = kSecond; }), "color_count > 1");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.destination_alpha = kSecond; }), "color_count > 1");
}

class DepthStencil : public ConformanceOf {};
TEST_P(DepthStencil, TestsAndWrites) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, DepthStencil, testing::ValuesIn(depth_stencil_cases()), case_name);

class Scissor : public ConformanceOf {};
TEST_P(Scissor, CutsAndChangesNothingInside) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Scissor, testing::ValuesIn(scissor_cases()), case_name);

class Interaction : public ConformanceOf {};
TEST_P(Interaction, OfOperations) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Interaction, testing::ValuesIn(interaction_cases()), case_name);

class PolygonOffset : public ConformanceOf {};
TEST_P(PolygonOffset, IsTheFormula) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, PolygonOffset, testing::ValuesIn(polygon_offset_cases()), case_name);

class Multisample : public ConformanceOf {};
TEST_P(Multisample, BySample) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Multisample, testing::ValuesIn(multisample_cases()), case_name);

class OcclusionQuery : public ConformanceOf {};
TEST_P(OcclusionQuery, CountsWhatPasses) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, OcclusionQuery, testing::ValuesIn(occlusion_query_cases()), case_name);

class Derivate : public ConformanceOf {};
TEST_P(Derivate, IsTheFormula) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Derivate, testing::ValuesIn(derivate_cases()), case_name);

class TextureFiltering : public ConformanceOf {};
TEST_P(TextureFiltering, FollowsTheRule) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureFiltering, testing::ValuesIn(texture_filtering_cases()), case_name);

class TextureMipmap : public ConformanceOf {};
TEST_P(TextureMipmap, ChoosesTheLevel) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureMipmap, testing::ValuesIn(texture_mipmap_cases()), case_name);

class Clears : public ConformanceOf {};
TEST_P(Clears, LeaveTheValue) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Clears, testing::ValuesIn(clears_cases()), case_name);

class Instanced : public ConformanceOf {};
TEST_P(Instanced, ComesInOrder) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Instanced, testing::ValuesIn(instanced_cases()), case_name);

class PrimitiveRestart : public ConformanceOf {};
TEST_P(PrimitiveRestart, IsManyDraws) { expect_right(); }
INSTANTIATE_TEST_SUITE_P(Conformance, PrimitiveRestart, testing::ValuesIn(primitive_restart_cases()), case_name);

}  // namespace halfspace::conformance
