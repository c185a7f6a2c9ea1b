// SPDX-License-Identifier: Apache-2.0
//
// Tests passes at the limits of valid input. Results are compared with the oracle byte for byte, or with known properties.
#include <gtest/gtest.h>

#include <xmmintrin.h>

#include <array>

#include "property/random_scene.h"

namespace halfspace {

namespace {

using Rows = std::vector<ColorShader::Attributes<float>>;

Scene scene_of(int width, int height, ColorFormat color = ColorFormat::rgba8, DepthFormat depth = DepthFormat::d32f) {
  Scene s;
  s.width = width;
  s.height = height;
  s.color.format = color;
  s.depth.format = depth;
  return s;
}

void add_draw(Scene& scene, const Rows& rows, const std::vector<uint32_t>& indices, const DrawState& state = {}) {
  scene.draws.push_back(make_draw(ColorShader{}, "ColorShader", rows, indices, state, VertexLayout::tight, IndexLayout::wide));
}

// Adds random triangles of several kinds.
void add_random(Scene& scene, uint64_t seed, const DrawState& state = {}) {
  Random random(seed);
  Geometry g;
  const Rect viewport = viewport_of(scene, state);
  for (const Kind kind : {Kind::whole_target, Kind::tiny, Kind::small, Kind::huge, Kind::sliver, Kind::behind_the_eye, Kind::mesh}) {
    add_triangles(kind, viewport, state.depth.clip, random, g);
  }
  Rows rows;
  for (const glm::vec4& p : g.positions) rows.push_back({p, {random.real(0, 1), random.real(0, 1), random.real(0, 1)}});
  add_draw(scene, rows, g.indices, state);
}

void expect_as_oracle(const Scene& scene) {
  const OracleResult oracle = run_oracle(scene);
  for (const int tile_size : {8, 16, 32, 64}) {
    for (const bool defer : {false, true}) {
      EXPECT_EQ(difference(scene, oracle.pictures, run_pass(scene, {.tuning = {.tile_size = tile_size, .defer = defer}}, 2).pictures), "")
          << "tiles of " << tile_size << (defer ? ", deferred" : ", immediate");
    }
  }
}

TEST(EdgeCases, TargetsFromOnePixelToTheLargestMatchTheOracle) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 2}, {3, 1}, {16384, 1}, {1, 16384}, {16383, 2}, {65, 63}}) {
    Scene s = scene_of(width, height, ColorFormat::rgba16f, DepthFormat::d24);
    add_random(s, static_cast<uint64_t>(width * 3 + height));
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    expect_as_oracle(s);
  }
}

TEST(EdgeCases, ViewportsBeyondTheTargetMatchTheOracle) {
  for (const Rect& viewport : {Rect{-16384, -16384, 16384, 16384}, Rect{-8000, -9000, 16384, 16384}, Rect{16384, 16384, 16384, 16384},
                               Rect{40, 30, 1, 1}, Rect{-7, -9, 200, 3}, Rect{69, 49, 300, 300}, Rect{-100, 20, 101, 5}}) {
    Scene s = scene_of(70, 50);
    add_random(s, 7, {.viewport = viewport});
    expect_as_oracle(s);
  }
}

TEST(EdgeCases, EmptyPartialAndOutsideScissorsMatchTheOracle) {
  for (const Rect& scissor : {Rect{0, 0, 0, 0}, Rect{10, 10, 0, 20}, Rect{10, 10, 20, 0}, Rect{-30, -30, 10, 10}, Rect{70, 50, 5, 5},
                              Rect{-5, -5, 20, 17}, Rect{17, 33, 1, 1}, Rect{-16384, -16384, 16384, 16384}, Rect{7, 9, 41, 33}}) {
    Scene s = scene_of(70, 50);
    add_random(s, 8, {.scissor = scissor});
    expect_as_oracle(s);
  }
}

TEST(EdgeCases, EmptyDrawsMatchTheOracle) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    Scene s = scene_of(70, 50);
    s.color.clear_value = glm::vec4(0.25f, 0.5f, 0.75f, 1.0f);
    const Rows rows(count, {glm::vec4(0, 0, 0, 1), glm::vec3(1)});
    add_draw(s, rows, std::vector<uint32_t>(count, 0));
    s.draws.push_back(
        make_draw(ColorShader{}, "sequential", rows, std::vector<uint32_t>(count, 0), {}, VertexLayout::tight, IndexLayout::none));
    expect_as_oracle(s);
  }
  expect_as_oracle(scene_of(33, 17));  // a pass without draws only clears
}

TEST(EdgeCases, DegenerateTrianglesDrawNothing) {
  Scene s = scene_of(40, 40);
  const Rows rows{{{-1, -1, 0, 1}, {1, 0, 0}}, {{1, 1, 0, 1}, {0, 1, 0}}, {{0, 0, 0, 1}, {0, 0, 1}}, {{0.0001f, 0, 0, 1}, {1, 1, 1}}};
  add_draw(s, rows, {0, 0, 0, 0, 1, 1, 0, 1, 2, 2, 3, 2, 2, 2, 3});
  expect_as_oracle(s);
  const PassStatistics statistics = run_pass(s, {}, 1).statistics;
  EXPECT_EQ(statistics.culled_degenerate, 5u);
  EXPECT_EQ(statistics.samples_passed, 0u);
}

TEST(EdgeCases, AHundredDrawsInOnePassMatchTheOracle) {
  Scene s = scene_of(100, 60, ColorFormat::srgb8a8, DepthFormat::d16);
  for (uint64_t d = 0; d < 100; ++d) {
    DrawState state;
    if (d % 3 == 1) state.blend.emplace();
    if (d % 5 == 2) state.scissor = Rect{static_cast<int>(d), 5, 40, 30};
    add_random(s, d, state);
  }
  expect_as_oracle(s);
}

TEST(EdgeCases, SharedVerticesMatchTheOracle) {
  Scene s = scene_of(64, 64);
  Random random(5);
  Rows rows;
  for (int i = 0; i < 12; ++i) {
    rows.push_back({glm::vec4{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1), random.real(0.5f, 2)},
                    glm::vec3{random.real(0, 1), random.real(0, 1), 1}});
  }
  std::vector<uint32_t> indices;
  for (int i = 0; i < 3000; ++i) indices.push_back(static_cast<uint32_t>(random.below(12)));
  add_draw(s, rows, indices, {.depth = {.compare = CompareOp::less_equal}});
  expect_as_oracle(s);
  EXPECT_EQ(run_pass(s, {}, 1).statistics.vertices_shaded, 12u);
}

TEST(EdgeCases, EqualPassesAtTheDepthsOfAnEarlierDraw) {
  for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
    Scene s = scene_of(150, 90, ColorFormat::rgba8, format);
    add_random(s, 11);
    Scene depth_first = s;  // draws the same triangles again with EQUAL: the last draw must win at every pixel
    add_random(depth_first, 11, {.depth = {.compare = CompareOp::equal}});
    expect_as_oracle(depth_first);
    const PassStatistics once = run_pass(s, {}, 1).statistics, twice = run_pass(depth_first, {}, 1).statistics;
    EXPECT_GE(twice.samples_passed - once.samples_passed, 150u * 90u);  // every visible pixel passes
  }
}

TEST(EdgeCases, ReversedDepthMatchesTheOracle) {
  for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
    Scene s = scene_of(120, 80, ColorFormat::rgba32f, format);
    s.depth.clear_value = 0.0f;
    add_random(s, 12,
               {.depth = {.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one}, .offset = {.slope = 1.5f, .constant = 2.0f}});
    expect_as_oracle(s);
  }
}

TEST(EdgeCases, ExtremePositionsMatchTheOracle) {
  // Vertices at and near w = 0, edges through the eye, and magnitudes up to the largest floats must not crash and must give the same
  // result.
  const std::array<float, 12> values{0.0f, -0.0f, 1.0f, -1.0f, 1e-30f, -1e-20f, 1e-38f, 3e38f, -3e38f, 1e20f, 0.5f, -2.0f};
  for (const bool clamp : {false, true}) {
    Scene s = scene_of(64, 48, ColorFormat::rgba8);
    Random random(13);
    Rows rows;
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 6000; ++i) {
      glm::vec4 p;
      for (int k = 0; k < 4; ++k) p[k] = values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
      rows.push_back({p, {random.real(0, 1), random.real(0, 1), random.real(0, 1)}});
      indices.push_back(i);
    }
    add_draw(s, rows, indices, {.depth = {.compare = CompareOp::less_equal, .clamp = clamp}});
    expect_as_oracle(s);
  }
}

TEST(EdgeCases, LoadOpDontCareUnderAFullScreenDrawMatchesTheOracle) {
  Scene s = scene_of(77, 41);
  s.color.load = s.depth.load = LoadOp::dont_care;
  s.color_before.assign(77 * 41 * 4, std::byte{0x5a});
  const Rows rows{{{-1, -1, 0, 1}, {1, 0.5f, 0}}, {{3, -1, 0, 1}, {0, 1, 0}}, {{-1, 3, 0, 1}, {0, 0.2f, 1}}};
  add_draw(s, rows, {0, 1, 2}, {.depth = {.compare = CompareOp::always}});
  expect_as_oracle(s);
}

TEST(EdgeCases, StoreOpDontCareDoesNotChangeTheImages) {
  const Rows rows{{{-1, -1, 0, 1}, {1, 1, 1}}, {{3, -1, 0, 1}, {1, 1, 1}}, {{-1, 3, 0, 1}, {1, 1, 1}}};
  Image<glm::u8vec4> color(70, 50);
  Image<float> depth(70, 50);
  ColorTarget c = rgba8_target(color);
  DepthTarget d = d32f_target(depth);
  c.load = d.load = LoadOp::load;
  c.store = d.store = StoreOp::dont_care;
  Pass pass(70, 50, c, d);
  pass.draw(ColorShader{}, make_vertex_view(stream(rows)));
  pass.run(Workers(1));
  EXPECT_EQ(color, Image<glm::u8vec4>(70, 50));
  EXPECT_EQ(depth, Image<float>(70, 50));
}

TEST(EdgeCases, APassCanBeReused) {
  const Rows rows{{{-1, -1, 0, 1}, {1, 0, 0}}, {{1, -1, 0, 1}, {0, 1, 0}}, {{0, 1, 0, 1}, {0, 0, 1}}};
  Image<glm::u8vec4> color(70, 50);
  Pass pass(70, 50, rgba8_target(color), {.format = DepthFormat::d32f});
  pass.draw(ColorShader{}, make_vertex_view(stream(rows)));
  pass.run(Workers(1));
  const Image<glm::u8vec4> first = color;
  pass.run(Workers(1));
  EXPECT_EQ(color, Image<glm::u8vec4>(70, 50));  // no draws: cleared
  pass.draw(ColorShader{}, make_vertex_view(stream(rows)));
  pass.run(Workers(1));
  EXPECT_EQ(color, first);
}

TEST(EdgeCases, ZeroBudgetFlushesAndTerminates) {
  Scene s = scene_of(70, 50);
  for (const int seed : {14, 15, 16}) add_random(s, static_cast<uint64_t>(seed));
  const PassResult whole = run_pass(s, {}, 1);
  const PassResult flushed = run_pass(s, {.tuning = {.chunk_triangles = 1, .bin_budget = 0}}, 1);
  EXPECT_EQ(difference(s, whole.pictures, flushed.pictures), "");
  EXPECT_GE(flushed.statistics.flushes, 1u);
}

// Flushes between draws of every kind, with attachments that have no image.
TEST(EdgeCases, FlushesPreserveAttachmentsWithoutImages) {
  for (const ColorFormat format : {ColorFormat::rgba8, ColorFormat::srgb8a8, ColorFormat::rgba16f, ColorFormat::rgba32f}) {
    for (const DepthFormat depth : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
      Scene s = scene_of(90, 70, format, depth);
      s.has_color_image = s.has_depth_image = false;
      s.post_format = ColorFormat::rgba8;
      for (uint64_t d = 0; d < 6; ++d) {
        DrawState state;
        if (d % 2 == 1) state.blend.emplace();
        add_random(s, 20 + d, state);
      }
      const OracleResult oracle = run_oracle(s);
      const PassResult flushed = run_pass(s, {.tuning = {.chunk_triangles = 1, .bin_budget = 1}}, 2);
      EXPECT_GE(flushed.statistics.flushes, 5u);
      EXPECT_EQ(difference(s, oracle.pictures, flushed.pictures), "");
    }
  }
}

TEST(EdgeCases, FlushesWhenChunkIdsRunOut) {
  Scene s = scene_of(64, 64);
  Random random(30);
  Geometry g;
  while (g.indices.size() < 3 * 66000) add_triangles(Kind::tiny, {0, 0, 64, 64}, ClipDepth::negative_one_to_one, random, g);
  Rows rows;
  for (const glm::vec4& p : g.positions) rows.push_back({p, {random.real(0, 1), random.real(0, 1), random.real(0, 1)}});
  add_draw(s, rows, g.indices);
  const PassResult flushed = run_pass(s, {.tuning = {.chunk_triangles = 1}}, 1);
  EXPECT_EQ(flushed.statistics.flushes, 1u);
  EXPECT_EQ(difference(s, run_oracle(s).pictures, flushed.pictures), "");
}

TEST(EdgeCases, TheFloatModeOfTheCallerHasNoEffect) {
  Scene s = scene_of(90, 70, ColorFormat::rgba32f, DepthFormat::d32f);
  add_random(s, 31, {.depth = {.range_near = 0.1f, .range_far = 0.7f}, .offset = {.slope = 1.0f, .constant = 3.0f}});
  const PassResult expected = run_pass(s, {}, 2);
  for (const unsigned mode :
       {0x1f80u | 0x8040u, 0x1f80u | 0x2000u, 0x1f80u | 0x4000u, 0x1f80u | 0x6000u}) {  // no denormals; round down; up; toward zero
    const unsigned before = _mm_getcsr();
    _mm_setcsr(mode);
    const PassResult actual = run_pass(s, {}, 2);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    EXPECT_EQ(after & 0xffc0u, mode & 0xffc0u);  // the pass restores the mode
    EXPECT_EQ(difference(s, expected.pictures, actual.pictures), "") << "mode " << mode;
  }
}

TEST(EdgeCases, BlendStateOfADepthOnlyDrawIsIgnored) {
  Scene s = scene_of(70, 50, ColorFormat::none);
  const std::vector<DepthShader::Attributes<float>> rows{{{-1, -1, 0, 1}}, {{1, -1, 0.5f, 1}}, {{0, 1, 0, 1}}};
  DrawState state;
  state.blend.emplace();
  s.draws.push_back(make_draw(DepthShader{}, "DepthShader", rows, {0, 1, 2}, state, VertexLayout::tight, IndexLayout::wide));
  expect_as_oracle(s);
}

}  // namespace

}  // namespace halfspace
