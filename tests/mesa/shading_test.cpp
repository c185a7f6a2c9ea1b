// SPDX-License-Identifier: Apache-2.0
//
// Colours: interpolation of every kind, Blinn-Phong's light, textures.
#include "mesa_context.h"
#include "scenes.h"
#include "twin_pass.h"
#include "twin_shaders.h"

namespace halfspace::test {

namespace {

constexpr int kWidth = 640, kHeight = 360;
constexpr int kJudged = 200;

Figures finish(TwinPass& pass) {
  pass.run();
  const Figures figures = pass.figures(kJudged);
  report(figures);
  expect_agreement(figures);
  return figures;
}

struct SoupCase {
  const char* name;
  Soup soup;
  friend void PrintTo(const SoupCase& c, std::ostream* os) { *os << c.name; }
};

}  // namespace

// ---- interpolation ---------------------------------------------------------------------------------------------

class ColorsOf : public MesaFixture<testing::TestWithParam<SoupCase>> {
 protected:
  template <class S>
  void draw_soup(const S& shader, const DrawState& state = {}) {
    const ColoredMesh mesh = make_soup(GetParam().soup, kWidth, kHeight);
    TwinPass pass({.width = kWidth, .height = kHeight});
    pass.draw(shader, mesh.positions_and_colors(), mesh.indices, state);
    finish(pass);
  }
};

TEST_P(ColorsOf, Smooth) { draw_soup(SmoothColor{}); }
TEST_P(ColorsOf, NoPerspective) { draw_soup(LinearColor{}); }
TEST_P(ColorsOf, FlatFromTheLastVertex) { draw_soup(FlatColor{}); }
TEST_P(ColorsOf, FlatFromTheFirstVertex) { draw_soup(FlatColor{}, state_with([](DrawState& s) { s.provoking = ProvokingVertex::first; })); }

INSTANTIATE_TEST_SUITE_P(Soup, ColorsOf,
                         testing::Values(SoupCase{"tiny", {.triangles = 100000, .size = 2}},                           //
                                         SoupCase{"small", {.triangles = 10000, .size = 12}},                          //
                                         SoupCase{"large", {.triangles = 100, .size = 400}},                           //
                                         SoupCase{"slivers", {.triangles = 2000, .size = 300, .thickness = 0.7f}},     //
                                         SoupCase{"in_perspective", {.triangles = 500, .size = 100, .w_ratio = 100}},  //
                                         SoupCase{"crossing_near", {.triangles = 60, .size = 150, .crosses_near = true}}),
                         case_name);

// ---- light on a sphere -----------------------------------------------------------------------------------------

class SphereOf : public MesaFixture<testing::TestWithParam<ColorFormat>> {
 protected:
  template <class S>
  void draw_sphere(S shader, const Sphere& sphere = make_sphere(51, 200), const glm::vec3& eye = {0.0f, 0.8f, 2.7f}) {
    shader.eye = eye;
    shader.light = {2.0f, 3.0f, 4.0f};
    shader.clip_from_world = sphere_camera(eye, kWidth, kHeight);
    TwinPass pass({.width = kWidth, .height = kHeight, .format = GetParam()});
    pass.draw(shader, sphere.view(), sphere.indices, state_with([](DrawState& s) { s.cull = CullMode::back; }));
    finish(pass);
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

TEST_P(SphereOf, PhongPerPixelWithSrgbTextureSeenFromClose) {
  const Texture2D checker(make_checker(256, 128), TexelFormat::srgb8a8);
  TexturedPhong shader;
  shader.albedo = &checker;
  shader.sampler = {.wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};
  draw_sphere(shader, make_sphere(51, 200), {0.0f, 0.4f, 1.6f});
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
TEST_P(SphereOf, PhongOfManyTriangles) { draw_sphere(PhongPerPixel{}, make_sphere(201, 500)); }

INSTANTIATE_TEST_SUITE_P(Into, SphereOf, testing::Values(ColorFormat::rgba8, ColorFormat::srgb8a8),
                         [](const auto& test) { return std::string(test.param == ColorFormat::rgba8 ? "rgba8" : "srgb8a8"); });

}  // namespace halfspace::test
