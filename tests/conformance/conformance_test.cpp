// SPDX-License-Identifier: Apache-2.0
//
// Draws every case of every group (groups.h) with the tile path, and compares it with the oracle byte for byte and with its closed form, if
// it has one. docs/results/conformance.md describes what each group requires.
#include <gtest/gtest.h>

#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

class ConformanceOf : public testing::TestWithParam<Case> {
 protected:
  static void expect_no_error() {
    const std::string wrong = check(GetParam());
    EXPECT_EQ(wrong, "");
  }
};
const auto case_name = [](const auto& test) { return test.param.name; };

}  // namespace

void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

class FillRules : public ConformanceOf {};
TEST_P(FillRules, CoverEachSampleOnce) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, FillRules, testing::ValuesIn(fill_rules_cases()), case_name);

class Primitives : public ConformanceOf {};
TEST_P(Primitives, CoverTheCorrectSamples) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Primitives, testing::ValuesIn(primitives_cases()), case_name);

class Interpolation : public ConformanceOf {};
TEST_P(Interpolation, MatchesTheVertexValues) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Interpolation, testing::ValuesIn(interpolation_cases()), case_name);

class Culling : public ConformanceOf {};
TEST_P(Culling, DropsCulledFaces) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Culling, testing::ValuesIn(culling_cases()), case_name);

class FlatShading : public ConformanceOf {};
TEST_P(FlatShading, UsesTheProvokingVertex) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, FlatShading, testing::ValuesIn(flatshading_cases()), case_name);

class Clipping : public ConformanceOf {};
TEST_P(Clipping, PreservesTheInside) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Clipping, testing::ValuesIn(clipping_cases()), case_name);

class Blend : public ConformanceOf {};
TEST_P(Blend, MatchesTheFormula) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Blend, testing::ValuesIn(blend_cases()), case_name);

// Dual-source blending needs a second color output, regardless of which blend factor uses it.
TEST(ConformanceBlendDeathTest, DualSourceBlendingRequiresASecondColor) {
  Picture p;
  p.draws.resize(1);
  p.draws[0].vertices.resize(3, {glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
  const auto draw_with = [&](auto change) {
    p.draws[0].state.blend.emplace();
    change(*p.draws[0].state.blend);
    draw(p);
  };
  constexpr BlendFactor kSecond = BlendFactor::src1_alpha;
  EXPECT_DEATH(draw_with([](BlendState& b) { b.source_color = kSecond; }), "use a second source");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.destination_color = kSecond; }), "use a second source");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.source_alpha = kSecond; }), "use a second source");
  EXPECT_DEATH(draw_with([](BlendState& b) { b.destination_alpha = kSecond; }), "use a second source");
}

class DepthStencil : public ConformanceOf {};
TEST_P(DepthStencil, TestsAndWritesLikeOpenGl) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, DepthStencil, testing::ValuesIn(depth_stencil_cases()), case_name);

class Scissor : public ConformanceOf {};
TEST_P(Scissor, CutsWithoutChangingTheInside) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Scissor, testing::ValuesIn(scissor_cases()), case_name);

class Interaction : public ConformanceOf {};
TEST_P(Interaction, OfOperationsMatchesTheOracle) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Interaction, testing::ValuesIn(interaction_cases()), case_name);

class PolygonOffset : public ConformanceOf {};
TEST_P(PolygonOffset, MatchesTheFormula) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, PolygonOffset, testing::ValuesIn(polygon_offset_cases()), case_name);

class Multisample : public ConformanceOf {};
TEST_P(Multisample, WorksPerSample) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Multisample, testing::ValuesIn(multisample_cases()), case_name);

class OcclusionQuery : public ConformanceOf {};
TEST_P(OcclusionQuery, CountsPassingSamples) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, OcclusionQuery, testing::ValuesIn(occlusion_query_cases()), case_name);

class Derivate : public ConformanceOf {};
TEST_P(Derivate, MatchesTheFormula) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Derivate, testing::ValuesIn(derivate_cases()), case_name);

class TextureFiltering : public ConformanceOf {};
TEST_P(TextureFiltering, FollowsTheSpecification) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureFiltering, testing::ValuesIn(texture_filtering_cases()), case_name);

class TextureMipmap : public ConformanceOf {};
TEST_P(TextureMipmap, SelectsTheCorrectLevel) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, TextureMipmap, testing::ValuesIn(texture_mipmap_cases()), case_name);

class Clears : public ConformanceOf {};
TEST_P(Clears, SetTheClearValue) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Clears, testing::ValuesIn(clears_cases()), case_name);

class Instanced : public ConformanceOf {};
TEST_P(Instanced, DrawsInstancesInOrder) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Instanced, testing::ValuesIn(instanced_cases()), case_name);

class PrimitiveRestart : public ConformanceOf {};
TEST_P(PrimitiveRestart, MatchesSeparateDraws) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, PrimitiveRestart, testing::ValuesIn(primitive_restart_cases()), case_name);

class GeometryShading : public ConformanceOf {};
TEST_P(GeometryShading, MatchesTheEmittedPrimitives) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, GeometryShading, testing::ValuesIn(geometry_shading_cases()), case_name);

class Tessellation : public ConformanceOf {};
TEST_P(Tessellation, CoversThePatches) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, Tessellation, testing::ValuesIn(tessellation_cases()), case_name);

class CullDistance : public ConformanceOf {};
TEST_P(CullDistance, DropsPrimitivesOutsideAtAllVertices) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, CullDistance, testing::ValuesIn(cull_distance_cases()), case_name);

class SampleVariables : public ConformanceOf {};
TEST_P(SampleVariables, AreThoseOfTheSample) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, SampleVariables, testing::ValuesIn(sample_variables_cases()), case_name);

class ConditionalRendering : public ConformanceOf {};
TEST_P(ConditionalRendering, DrawsIfASampleHasPassed) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, ConditionalRendering, testing::ValuesIn(conditional_rendering_cases()), case_name);

class SmoothPrimitives : public ConformanceOf {};
TEST_P(SmoothPrimitives, AreWeightedByTheirArea) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, SmoothPrimitives, testing::ValuesIn(smooth_primitives_cases()), case_name);

class ViewportArrays : public ConformanceOf {};
TEST_P(ViewportArrays, DrawsPrimitivesIntoTheirViewports) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, ViewportArrays, testing::ValuesIn(viewport_array_cases()), case_name);

class VertexArrays : public ConformanceOf {};
TEST_P(VertexArrays, ReachTheFragments) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, VertexArrays, testing::ValuesIn(vertex_arrays_cases()), case_name);

class FragmentOutputs : public ConformanceOf {};
TEST_P(FragmentOutputs, AreStoredInTheirFormats) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, FragmentOutputs, testing::ValuesIn(fragment_outputs_cases()), case_name);

class LogicOps : public ConformanceOf {};
TEST_P(LogicOps, CombineTheBits) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, LogicOps, testing::ValuesIn(logic_ops_cases()), case_name);

class LayeredRendering : public ConformanceOf {};
TEST_P(LayeredRendering, DrawsEachLayerOnItsOwn) { expect_no_error(); }
INSTANTIATE_TEST_SUITE_P(Conformance, LayeredRendering, testing::ValuesIn(layered_rendering_cases()), case_name);

}  // namespace halfspace::conformance
