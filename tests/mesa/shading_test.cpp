// SPDX-License-Identifier: Apache-2.0
//
// Compares colors: interpolation qualifiers, Blinn-Phong lighting and textures.
#include "mesa/mesa_context.h"
#include "mesa/scenes.h"
#include "mesa/twin_pass.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

namespace {

constexpr int kShadingWidth = 640, kShadingHeight = 360;
constexpr int kJudged = 100;

void finish(TwinPass& pass, const char* what_mesa_does = nullptr) {
  pass.run();
  const Figures figures = pass.figures(kJudged);
  report(figures);
  expect_verdict(figures, what_mesa_does);
}

// Halfspace interpolates between snapped vertices, Mesa between unsnapped ones. OpenGL allows both. As a result, a color that changes by 1
// within a pixel differs by up to 1/256, and thin triangles have slightly different coverage.
constexpr const char* kUnsnapped = "interpolates between unsnapped vertices, and clips at the edges of the window to new ones";
constexpr const char* kClippedLinear =
    "loses noperspective varyings of triangles in perspective that are clipped at the edges of the window (22.3: even a constant becomes "
    "0)";
constexpr const char* kFastLog2 = "computes the level of detail with an approximate log2, which is off by up to 0.04 levels";

}  // namespace

// ---- interpolation ---------------------------------------------------------------------------------------------

class SoupTest : public MesaFixture<testing::TestWithParam<SoupCase>> {
 protected:
  template <class S>
  void draw_soup(const S& shader, int width, int height, const char* what_mesa_does, const DrawState& state = {}) {
    const ColoredMesh mesh = make_soup(GetParam().soup, width, height);
    TwinPass pass({.width = width, .height = height});
    pass.draw(shader, mesh.positions_and_colors(), mesh.indices, state);
    finish(pass, what_mesa_does);
  }
};
const DrawState kFirstVertex = state_with([](DrawState& s) { s.provoking = ProvokingVertex::first; });

// Positions are on the 1/256 px grid, so snapping does not move them. Both renderers must agree for every size and shape.
class ColorsOnGrid : public SoupTest {
 protected:
  template <class S>
  void draw(const S& shader, const DrawState& state = {}) {
    draw_soup(shader, 1024, 256, GetParam().what_mesa_does, state);
  }
};
TEST_P(ColorsOnGrid, SmoothAgrees) { draw(SmoothColor{}); }
TEST_P(ColorsOnGrid, NoperspectiveMatchesTheReference) { draw(LinearColor{}); }
TEST_P(ColorsOnGrid, FlatFromTheLastVertexAgrees) { draw(FlatColor{}); }
TEST_P(ColorsOnGrid, FlatFromTheFirstVertexAgrees) { draw(FlatColor{}, kFirstVertex); }

constexpr float kShadingGrid = 1.0f / 256.0f;
INSTANTIATE_TEST_SUITE_P(
    Soup, ColorsOnGrid,
    testing::Values(SoupCase{"tiny", {.triangles = 50000, .size = 2, .grid = kShadingGrid, .inside = true}},    //
                    SoupCase{"small", {.triangles = 10000, .size = 12, .grid = kShadingGrid, .inside = true}},  //
                    SoupCase{"large", {.triangles = 100, .size = 120, .grid = kShadingGrid, .inside = true}},   //
                    SoupCase{"slivers", {.triangles = 2000, .size = 120, .thickness = 0.7f, .grid = kShadingGrid, .inside = true}},
                    SoupCase{"in_perspective", {.triangles = 500, .size = 100, .w_ratio = 100, .grid = kShadingGrid, .inside = true}}),
    case_name);

// Positions are not aligned to the grid, and triangles extend beyond the window or cross the near plane.
class ColorsOf : public SoupTest {
 protected:
  template <class S>
  void draw(const S& shader, const DrawState& state = {}) {
    const bool linear = std::is_same_v<S, LinearColor>;
    const bool clipped = GetParam().soup.w_ratio > 1 || GetParam().soup.crosses_near;
    draw_soup(shader, kShadingWidth, kShadingHeight, linear && clipped ? kClippedLinear : GetParam().what_mesa_does, state);
  }
};
TEST_P(ColorsOf, SmoothAgrees) { draw(SmoothColor{}); }
TEST_P(ColorsOf, NoperspectiveMatchesTheReference) { draw(LinearColor{}); }
TEST_P(ColorsOf, FlatFromTheLastVertexAgrees) { draw(FlatColor{}); }
TEST_P(ColorsOf, FlatFromTheFirstVertexAgrees) { draw(FlatColor{}, kFirstVertex); }

INSTANTIATE_TEST_SUITE_P(Soup, ColorsOf,
                         testing::Values(SoupCase{"tiny", {.triangles = 50000, .size = 2}, kUnsnapped},                         //
                                         SoupCase{"small", {.triangles = 10000, .size = 12}},                                   //
                                         SoupCase{"large", {.triangles = 100, .size = 400}},                                    //
                                         SoupCase{"slivers", {.triangles = 2000, .size = 300, .thickness = 0.7f}, kUnsnapped},  //
                                         SoupCase{"in_perspective", {.triangles = 500, .size = 100, .w_ratio = 100}},           //
                                         SoupCase{"crossing_near", {.triangles = 60, .size = 150, .crosses_near = true}}),
                         case_name);

// ---- lit spheres -----------------------------------------------------------------------------------------------

class SphereOf : public MesaFixture<testing::TestWithParam<ColorFormat>> {
 protected:
  template <class S>
  void draw_sphere(S shader, const char* what_mesa_does = nullptr, const Sphere& sphere = make_sphere(51, 200),
                   const glm::vec3& eye = {0.0f, 0.8f, 2.7f}) {
    shader.eye = eye;
    shader.light = {2.0f, 3.0f, 4.0f};
    shader.clip_from_world = sphere_camera(eye, kShadingWidth, kShadingHeight);
    TwinPass pass({.width = kShadingWidth, .height = kShadingHeight, .format = GetParam()});
    pass.draw(shader, sphere.view(), sphere.indices, state_with([](DrawState& s) { s.cull = CullMode::back; }));
    finish(pass, what_mesa_does);
  }
};

TEST_P(SphereOf, PhongPerPixel) {
  PhongPerPixel shader;
  shader.base = {0.8f, 0.3f, 0.2f};
  draw_sphere(shader);
}

TEST_P(SphereOf, PhongPerPixelWithTrilinearTexture) {
  const Texture2D checker(make_checker(2048, 1024), TexelFormat::rgba8);
  TexturedPhong shader;
  shader.albedo = &checker;
  shader.sampler = {.wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};
  draw_sphere(shader);
}

TEST_P(SphereOf, PhongPerPixelWithTrilinearTextureAtMesasLevel) {
  const Texture2D checker(make_checker(2048, 1024), TexelFormat::rgba8);
  ImplicitlyTexturedPhong shader;
  shader.albedo = &checker;
  shader.sampler = {.wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};
  draw_sphere(shader, kFastLog2);
}

TEST_P(SphereOf, PhongPerPixelWithSrgbTextureSeenFromClose) {
  const Texture2D checker(make_checker(256, 128), TexelFormat::srgb8a8);
  TexturedPhong shader;
  shader.albedo = &checker;
  shader.sampler = {.wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};
  draw_sphere(shader, nullptr, make_sphere(51, 200), {0.0f, 0.4f, 1.6f});
}

TEST_P(SphereOf, PhongPerPixelWithNearestTexels) {
  const Texture2D checker(make_checker(128, 64), TexelFormat::rgba8);
  TexturedPhong shader;
  shader.albedo = &checker;
  shader.sampler = {.mag = Filter::nearest, .min = Filter::nearest, .wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};
  draw_sphere(shader);
}

TEST_P(SphereOf, Gouraud) { draw_sphere(Gouraud{}); }
TEST_P(SphereOf, FlatTriangles) { draw_sphere(FlatLit{}); }
TEST_P(SphereOf, PhongOfManyTriangles) { draw_sphere(PhongPerPixel{}, nullptr, make_sphere(201, 500)); }

INSTANTIATE_TEST_SUITE_P(Into, SphereOf, testing::Values(ColorFormat::rgba8, ColorFormat::srgb8a8),
                         [](const auto& test) { return std::string(test.param == ColorFormat::rgba8 ? "rgba8" : "srgb8a8"); });

}  // namespace halfspace::test
