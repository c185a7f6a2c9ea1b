// SPDX-License-Identifier: Apache-2.0
//
// Compares coverage. Every fragment adds 1/255, so a pixel stores the number of triangles that cover it, and a fragment drawn by only one
// renderer cannot be hidden by another fragment.
#include "mesa/mesa_context.h"
#include "mesa/scenes.h"
#include "mesa/twin_pass.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

namespace {

DrawState counting() {
  DrawState state;
  state.depth.test = false;
  state.depth.write = false;
  state.blend = BlendState{.source_color = BlendFactor::one,
                           .destination_color = BlendFactor::one,
                           .source_alpha = BlendFactor::one,
                           .destination_alpha = BlendFactor::one};
  return state;
}

Figures count_fragments(const ColoredMesh& mesh, const TargetSpec& target) {
  TwinPass pass(target);
  pass.draw(OneColor{glm::vec4(1.0f / 255.0f)}, mesh.positions(), mesh.indices, counting());
  pass.run();
  const Figures figures = pass.fragment_figures(200);
  report(figures);
  return figures;
}

// Reasons why coverage may differ. They matter where coverage depends on a difference of 1/256 px: on thin triangles, and at edges through
// pixel centers. Halfspace rounds the exact quotient x/w to the grid and does not clip at the edges of the window.
constexpr const char* kRounding = "rounds window coordinates to float before snapping them to 1/256 px";
constexpr const char* kClipping =
    "clips triangles at the edges of the window to new vertices, which are also snapped, and rounds before snapping";

}  // namespace

// Positions are on the 1/256 px grid and inside a window in which clip coordinates represent them exactly, so there is no rounding or
// clipping. Not a single fragment may differ.
class CoverageOnGrid : public MesaFixture<testing::TestWithParam<SoupCase>> {};

TEST_P(CoverageOnGrid, IsIdentical) {
  const Figures figures = count_fragments(make_soup(GetParam().soup, 1024, 256), {.width = 1024, .height = 256});
  EXPECT_GT(figures.covered, 1000);
  EXPECT_EQ(figures.coverage_differs, 0);
}

constexpr float kGrid = 1.0f / 256.0f;
INSTANTIATE_TEST_SUITE_P(
    Soup, CoverageOnGrid,
    testing::Values(SoupCase{"tiny", {.triangles = 200000, .size = 2, .grid = kGrid, .inside = true}},                        //
                    SoupCase{"small", {.triangles = 20000, .size = 12, .grid = kGrid, .inside = true}},                       //
                    SoupCase{"large", {.triangles = 200, .size = 120, .grid = kGrid, .inside = true}},                        //
                    SoupCase{"slivers", {.triangles = 5000, .size = 120, .thickness = 0.7f, .grid = kGrid, .inside = true}},  //
                    SoupCase{"in_perspective", {.triangles = 2000, .size = 60, .w_ratio = 100, .grid = kGrid, .inside = true}},
                    SoupCase{"on_half_pixels", {.triangles = 5000, .size = 20, .grid = 0.5f, .inside = true}},  //
                    SoupCase{"on_quarter_pixels", {.triangles = 50000, .size = 3, .grid = 0.25f, .inside = true}}),
    case_name);

// Positions are not aligned to the grid.
class CoverageOf : public MesaFixture<testing::TestWithParam<SoupCase>> {};

TEST_P(CoverageOf, DiffersOnAtMostOneFragmentInTenThousand) {
  const Figures figures = count_fragments(make_soup(GetParam().soup, 640, 360), {.width = 640, .height = 360});
  EXPECT_GT(figures.covered, 1000);
  expect_verdict(figures, GetParam().what_mesa_does);
}

INSTANTIATE_TEST_SUITE_P(
    Soup, CoverageOf,
    testing::Values(SoupCase{"tiny", {.triangles = 100000, .size = 2}, kRounding},                        //
                    SoupCase{"small", {.triangles = 20000, .size = 12}},                                  //
                    SoupCase{"large", {.triangles = 200, .size = 400}},                                   //
                    SoupCase{"beyond_the_window", {.triangles = 100, .size = 3000}},                      //
                    SoupCase{"beyond_the_guard_band", {.triangles = 100, .size = 40000}},                 //
                    SoupCase{"slivers", {.triangles = 5000, .size = 300, .thickness = 0.7f}, kClipping},  //
                    SoupCase{"slivers_inside", {.triangles = 5000, .size = 150, .thickness = 0.7f, .inside = true}, kRounding},
                    SoupCase{"in_perspective", {.triangles = 2000, .size = 60, .w_ratio = 100}},           //
                    SoupCase{"on_half_pixels", {.triangles = 5000, .size = 20, .grid = 0.5f}, kClipping},  //
                    SoupCase{"crossing_near", {.triangles = 300, .size = 150, .crosses_near = true}}),
    case_name);

using Coverage = MesaTest;

// Every pixel of a mesh of shared vertices that covers the window must be drawn exactly once by both renderers.
TEST_F(Coverage, IsOneEverywhereForMeshesWithSharedVertices) {
  for (const float jitter : {0.0f, 0.1f, 0.3f}) {
    const ColoredMesh mesh = make_sheet(150, 90, jitter, 7);
    TwinPass pass({.width = 640, .height = 360});
    pass.draw(OneColor{glm::vec4(1.0f / 255.0f)}, mesh.positions(), mesh.indices, counting());
    pass.run();
    report(pass.fragment_figures());
    for (const Picture* picture : {&pass.halfspace(), &pass.mesa()}) {
      int64_t not_once = 0;
      for (const glm::u8vec4& c : picture->color.texels()) not_once += c.x != 1;
      EXPECT_EQ(not_once, 0) << (picture == &pass.mesa() ? "Mesa" : "Halfspace") << ", jitter " << jitter;
    }
  }
}

TEST_F(Coverage, AgreesForAdjacentTinyTriangles) {
  const Figures figures = count_fragments(make_tiny(640, 360), {.width = 640, .height = 360});
  EXPECT_LE(figures.coverage_share(), 1e-4);
}

}  // namespace halfspace::test
