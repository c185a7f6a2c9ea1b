// SPDX-License-Identifier: Apache-2.0
//
// Tests smooth lines and polygons: the alpha of a pixel is the area that the primitive covers.
#include "halfspace/core/half.h"
#include "raster/raster_test.h"
#include "support/pixel_area.h"

namespace halfspace::raster_test::smooth_test {
namespace {

constexpr int kSize = 64;

// Adds the alpha of each fragment, which starts as 1.
constexpr DrawState kSumOfAreas{.polygon_smooth = true, .blend = kAdd};

Image<glm::vec4> draw(const std::vector<glm::vec4>& p, const DrawState& state, const PassOptions& options = {},
                      const Workers& workers = two_workers()) {
  Image<glm::vec4> image(kSize, kSize);
  Pass pass(kSize, kSize, rgba32f_target(image), {}, options);
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)), state);
  pass.run(workers);
  return image;
}

glm::vec4 at(double x, double y) { return {static_cast<float>(x * 2 / kSize - 1), static_cast<float>(y * 2 / kSize - 1), 0.0f, 1.0f}; }

TEST(SmoothPolygons, AlphaIsTheExactArea) {
  Random random(3);
  double largest = 0.0;
  for (int i = 0; i < effort(200); ++i) {
    const double size = i % 4 == 0 ? 0.7 : i % 4 == 1 ? 5 : 40;
    const glm::dvec2 center(random.real(0, kSize), random.real(0, kSize));
    std::array<glm::dvec2, 3> t;
    for (glm::dvec2& v : t) {
      v = center + glm::dvec2(random.real(-size, size), random.real(-size, size));
      v = glm::round(v * 256.0) / 256.0;  // the pipeline snaps to this grid
    }
    const Image<glm::vec4> image = draw({at(t[0].x, t[0].y), at(t[1].x, t[1].y), at(t[2].x, t[2].y)}, kSumOfAreas);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x)
        largest = std::max(largest, std::fabs(area_in_pixel(t, x, y) - static_cast<double>(pixel(image, x, y).w)));
    }
  }
  RecordProperty("largest error", std::to_string(largest));
  EXPECT_LT(largest, 1e-7);  // alpha is a float, with an error of up to 2^-25; the reference moves breakpoints by 1e-9
}

TEST(SmoothPolygons, KnownAreas) {
  const Image<glm::vec4> half = draw({at(8, 8), at(40, 8), at(8, 40)}, kSumOfAreas);
  for (int i = 0; i < 32; ++i) EXPECT_EQ(pixel(half, 8 + i, 39 - i).w, 0.5f);
  EXPECT_EQ(pixel(half, 9, 9).w, 1.0f);
  EXPECT_EQ(pixel(half, 40, 40).w, 0.0f);
  // A square of a quarter of a pixel, in two triangles.
  const Image<glm::vec4> tiny =
      draw({at(8.25, 8.25), at(8.75, 8.25), at(8.75, 8.75), at(8.25, 8.25), at(8.75, 8.75), at(8.25, 8.75)}, kSumOfAreas);
  EXPECT_EQ(pixel(tiny, 8, 8).w, 0.25f);
}

TEST(SmoothPolygons, AreasOfAMeshAddUpToOne) {
  Random random(5);
  std::vector<glm::vec4> corners, p;
  for (int y = 0; y <= 6; ++y) {
    for (int x = 0; x <= 6; ++x) {
      const bool inner = x > 0 && x < 6 && y > 0 && y < 6;
      const auto moved = [&](int k) { return 4 + k * 9.0 + (inner ? random.real(-3, 3) : 0.0); };
      corners.push_back(at(moved(x), moved(y)));
    }
  }
  for (std::size_t y = 0; y < 6; ++y) {
    for (std::size_t x = 0; x < 6; ++x) {
      const std::size_t i = y * 7 + x;
      for (const std::size_t k : {i, i + 1, i + 8, i, i + 8, i + 7}) p.push_back(corners[k]);
    }
  }
  const Image<glm::vec4> image = draw(p, kSumOfAreas);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool inside = x >= 4 && x < 58 && y >= 4 && y < 58;
      EXPECT_NEAR(pixel(image, x, y).w, inside ? 1.0f : 0.0f, 1e-6f) << x << ' ' << y;  // up to eight roundings to float
    }
  }
}

TEST(SmoothPolygons, TilesAndThreadsDoNotMatter) {
  Random random(6);
  std::vector<glm::vec4> p;
  for (int i = 0; i < 90; ++i) p.push_back(at(random.real(-20, 84), random.real(-20, 84)));
  const Image<glm::vec4> expected = draw(p, kSumOfAreas);
  for (const int tile_size : {8, 16, 32}) EXPECT_EQ(draw(p, kSumOfAreas, {.tuning = {.tile_size = tile_size}}), expected);
  EXPECT_EQ(draw(p, kSumOfAreas, {.tuning = {.chunk_triangles = 2, .bin_budget = 1}}), expected);
  EXPECT_EQ(draw(p, kSumOfAreas, {}, one_worker()), expected);
}

// Emits a triangle for each line.
struct Emitting : ConstantShader {
  static constexpr GeometryLayout geometry_layout{.input = GeometryInputPrimitive::lines,
                                                  .output = GeometryOutputPrimitive::triangle_strip};
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 2>& in, Emitter<R, Varyings<R>>& out) const {
    out.emit(in.position[0], in.varyings[0]);
    out.emit(in.position[1], in.varyings[0]);
    out.emit(vec4<R>(in.position[0].x, in.position[1].y, in.position[0].z, in.position[0].w), in.varyings[0]);
  }
};

TEST(SmoothPolygons, EmittedTrianglesAreSmooth) {
  Image<glm::vec4> image(kSize, kSize);
  Pass pass(kSize, kSize, rgba32f_target(image), {});
  const std::vector<glm::vec4> ends{at(40, 8), at(8, 40)};
  pass.draw(Emitting{}, make_vertex_view(stream(ends)), {.topology = Topology::lines, .polygon_smooth = true});
  pass.run(one_worker());
  const std::vector<glm::vec4> p{at(40, 8), at(8, 40), at(40, 40)};
  EXPECT_EQ(image, draw(p, {.polygon_smooth = true}));
  EXPECT_EQ(pixel(image, 30, 17).w, 0.5f);
}

// The early test of a promise uses the depth that Pixel::z() has.
struct BehindShader : PositionShader {
  static constexpr ConservativeDepth conservative_depth = ConservativeDepth::greater;
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(1)), MaskOf<R>(true), px.z()};
  }
};

TEST(SmoothPolygons, DepthOfTheShaderIsThatOfTheTest) {
  Image<float> own(kSize, kSize), expected(kSize, kSize);
  Image<glm::vec4> image(kSize, kSize);
  std::vector<glm::vec4> p{at(8.25, 8.25), at(40, 9), at(9, 40)};
  p[0].z = -0.5f, p[1].z = 0.0f, p[2].z = 0.5f;
  for (Image<float>* const depth : {&own, &expected}) {
    Pass pass(kSize, kSize, rgba32f_target(image), d32f_target(*depth));
    const DrawState state{.polygon_smooth = true};
    if (depth == &own) {
      pass.draw(BehindShader{}, make_vertex_view(stream(p)), state);
    } else {
      pass.draw(ConstantShader{}, make_vertex_view(stream(p)), state);
    }
    pass.run(one_worker());
  }
  for (int i = 0; i < kSize * kSize; ++i) EXPECT_NEAR(own.data()[i], expected.data()[i], 0x1p-23f);  // the rounding of both
}

TEST(SmoothPolygons, BlendWithTheAreaAsAlpha) {
  const DrawState state{.polygon_smooth = true, .blend = kAlphaBlend};
  Image<glm::vec4> image(kSize, kSize);
  ColorTarget target = rgba32f_target(image);
  target.clear_value = {0.5f, 0.5f, 0.5f, 1.0f};
  Pass pass(kSize, kSize, target, {});
  const std::vector<glm::vec4> p{at(8, 8), at(40, 8), at(8, 40)};
  pass.draw(ConstantShader{{1, 0, 0, 0.5f}}, make_vertex_view(stream(p)), state);
  pass.run(one_worker());
  EXPECT_EQ(pixel(image, 9, 9), glm::vec4(0.75f, 0.25f, 0.25f, 1.0f));
  EXPECT_EQ(pixel(image, 20, 27), glm::vec4(0.625f, 0.375f, 0.375f, 1.0f));
}

// Two colors and an integer: only alphas of colors are multiplied.
struct ThreeOutputs : PositionShader {
  template <class R>
  TypedFragment<R, vec4<R>, uvec4<R>, vec4<R>> fragment(const Varyings<R>&) const {
    const IntOf<R> seven(7);
    return {{vec4<R>(R(1), R(1), R(1), R(1)), uvec4<R>(ivec4<R>(seven, seven, seven, seven)), vec4<R>(R(0), R(0), R(0), R(0.5f))}};
  }
};

TEST(SmoothPolygons, OnlyTheAlphasOfColorsAreMultiplied) {
  Image<glm::vec4> first(kSize, kSize), third(kSize, kSize);
  Image<uint32_t> second(kSize, kSize);
  const std::vector<ColorTarget> targets{rgba32f_target(first), r32ui_target(second), rgba32f_target(third)};
  Pass pass(kSize, kSize, targets, {});
  const std::vector<glm::vec4> p{at(8, 8), at(40, 8), at(8, 40)};
  pass.draw(ThreeOutputs{}, make_vertex_view(stream(p)), {.polygon_smooth = true});
  pass.run(one_worker());
  EXPECT_EQ(pixel(first, 20, 27), glm::vec4(1, 1, 1, 0.5f));
  EXPECT_EQ(pixel(second, 20, 27), 7u);
  EXPECT_EQ(pixel(third, 20, 27), glm::vec4(0, 0, 0, 0.25f));
}

TEST(SmoothPolygons, DepthsAreThoseOfThePrimitive) {
  Image<glm::vec4> image(kSize, kSize);
  Image<float> depth(kSize, kSize);
  Pass pass(kSize, kSize, rgba32f_target(image), d32f_target(depth));
  std::vector<glm::vec4> p{at(8.25, 8.25), at(40, 9), at(9, 40)};
  p[0].z = -0.5f, p[1].z = 0.0f, p[2].z = 0.5f;
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.polygon_smooth = true});
  pass.run(one_worker());
  for (int i = 0; i < kSize * kSize; ++i) {
    const float z = depth.data()[i];
    EXPECT_EQ(z == 1.0f, image.data()[i].w == 0.0f);
    EXPECT_TRUE(z == 1.0f || (z >= 0.25f && z <= 0.75f)) << z;
  }
  // What is behind is hidden, also at the edges.
  const std::vector<glm::vec4> behind = full_screen(0.6f);
  Pass both(kSize, kSize, rgba32f_target(image), d32f_target(depth));
  both.draw(ConstantShader{}, make_vertex_view(stream(p)), {.polygon_smooth = true});
  both.draw(ConstantShader{{5, 5, 5, 5}}, make_vertex_view(stream(behind)));
  both.run(one_worker());
  for (int i = 0; i < kSize * kSize; ++i) EXPECT_EQ(image.data()[i].x, depth.data()[i] < 0.8f ? 1.0f : 5.0f);
}

TEST(SmoothPolygons, AreNotSmoothWithSeveralSamples) {
  const std::vector<glm::vec4> p{at(8.3, 8.1), at(40, 9), at(9, 40)};
  EXPECT_EQ(draw(p, kSumOfAreas, {.samples = 4}), draw(p, {.blend = kAdd}, {.samples = 4}));
}

TEST(SmoothLines, RowsHaveTheirPartOfTheWidth) {
  for (const float width : {0.5f, 1.0f, 1.5f, 2.25f, 5.0f}) {
    const Image<glm::vec4> image =
        draw({at(8.5, 20.25), at(30.25, 20.25)}, {.topology = Topology::lines, .line_width = width, .line_smooth = true, .blend = kAdd});
    for (int y = 0; y < kSize; ++y) {
      const auto row = static_cast<float>(y);
      const float rows = std::max(0.0f, std::min(row + 1, 20.25f + width / 2) - std::max(row, 20.25f - width / 2));
      EXPECT_EQ(pixel(image, 8, y).w, rows * 0.5f) << y;
      EXPECT_EQ(pixel(image, 20, y).w, rows) << y;
      EXPECT_EQ(pixel(image, 30, y).w, rows * 0.25f) << y;
      EXPECT_EQ(pixel(image, 7, y).w, 0.0f);
      EXPECT_EQ(pixel(image, 31, y).w, 0.0f);
    }
  }
}

TEST(SmoothLines, HaveTheAreaOfARectangle) {
  Random random(8);
  for (int i = 0; i < effort(200); ++i) {
    const glm::dvec2 a(random.integer(10 * 256, 54 * 256) / 256.0, random.integer(10 * 256, 54 * 256) / 256.0);
    const glm::dvec2 b(random.integer(10 * 256, 54 * 256) / 256.0, random.integer(10 * 256, 54 * 256) / 256.0);
    const auto width = static_cast<float>(random.real(0.25, 8.0));
    const DrawState state{.topology = Topology::lines, .line_width = width, .line_smooth = true, .blend = kAdd};
    const Image<glm::vec4> image = draw({at(a.x, a.y), at(b.x, b.y)}, state);
    double sum = 0.0;
    for (int k = 0; k < kSize * kSize; ++k) sum += static_cast<double>(image.data()[k].w);
    // Up to 600 pixels are rounded to float, each with an error of up to 2^-25.
    EXPECT_NEAR(sum, static_cast<double>(width) * glm::length(b - a), 2e-5);
  }
}

TEST(SmoothLines, OutlinesOfTrianglesAreSmooth) {
  const std::vector<glm::vec4> p{at(8, 8), at(40, 8), at(8, 40)};
  const Image<glm::vec4> outline = draw(p, {.polygon_mode = PolygonMode::line, .line_smooth = true, .blend = kAdd});
  EXPECT_EQ(pixel(outline, 20, 7).w, 0.5f);
  EXPECT_EQ(pixel(outline, 20, 8).w, 0.5f);
  EXPECT_EQ(pixel(outline, 20, 9).w, 0.0f);
  // Filled triangles are not smooth if only lines are.
  EXPECT_EQ(draw(p, {.line_smooth = true}), draw(p, {}));
  EXPECT_EQ(draw(p, {.polygon_mode = PolygonMode::line, .polygon_smooth = true}), draw(p, {.polygon_mode = PolygonMode::line}));
}

}  // namespace
}  // namespace halfspace::raster_test::smooth_test
