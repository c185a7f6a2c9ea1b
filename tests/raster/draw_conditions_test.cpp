// SPDX-License-Identifier: Apache-2.0
//
// Tests what decides about whole draws or about stored depths: conditional draws, depth bounds, records of draws and timers.
#include <algorithm>

#include "raster/raster_test.h"

namespace halfspace::raster_test::draw_conditions_test {
namespace {

constexpr int kWidth = 70, kHeight = 45;

// Replaces the color, but as blending, so that fragments are queued and shaded in order.
constexpr BlendState kReplace{.source_color = BlendFactor::one,
                              .destination_color = BlendFactor::zero,
                              .source_alpha = BlendFactor::one,
                              .destination_alpha = BlendFactor::zero};

struct Mesh {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

Mesh heap(Random& random, int triangles, double size) {
  Mesh m;
  for (int i = 0; i < triangles; ++i) {
    const auto value = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    const glm::vec2 center(value(-1, 1), value(-1, 1));
    for (int k = 0; k < 3; ++k) {
      m.positions.push_back({center.x + value(-size, size), center.y + value(-size, size), value(-0.9, 0.9), 1});
      m.colors.push_back({value(0, 1), value(0, 1), value(0, 1), 1});
    }
  }
  return m;
}

// Emits each triangle twice, the second time moved.
struct Doubling : SmoothColorShader {
  static constexpr GeometryLayout geometry_layout{.max_vertices = 3, .invocations = 2};
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      vec4<R> p = in.position[i];
      p.x = p.x + R(0.25f * static_cast<float>(in.invocation));
      out.emit(p, in.varyings[i]);
    }
  }
};

struct Step {
  Mesh mesh;
  DrawState state;
  bool emits = false;
};

void add(Pass& pass, const Step& step, const DrawState& state) {
  if (step.emits) return pass.draw(Doubling{}, step.mesh.view(), state);
  pass.draw(SmoothColorShader{}, step.mesh.view(), state);
}

struct Pictures {
  Image<glm::vec4> color{kWidth, kHeight};
  Image<float> depth{kWidth, kHeight};
};

// Draws each step in a pass of its own, and decides from the counts of the queries so far. With several samples, passes would lose the
// samples between them, so the pictures of this function have one.
Pictures draw_one_by_one(const std::vector<Step>& steps, std::vector<uint64_t>& queries, std::vector<bool>& drawn) {
  Pictures p;
  bool is_first = true;
  for (const Step& step : steps) {
    DrawState state = step.state;
    state.condition.reset();
    bool draws = true;
    if (step.state.condition) {
      const auto& [query, inverted] = *step.state.condition;
      draws = (query < queries.size() && queries[query] != 0) != inverted;
    }
    drawn.push_back(draws);
    ColorTarget color = rgba32f_target(p.color);
    DepthTarget depth = d32f_target(p.depth);
    if (!is_first) color.load = depth.load = LoadOp::load;
    is_first = false;
    Pass pass(kWidth, kHeight, color, depth);
    if (draws) add(pass, step, state);
    const PassStatistics s = pass.run(one_worker());
    queries.resize(std::max(queries.size(), s.queries.size()));
    for (std::size_t i = 0; i < s.queries.size(); ++i) queries[i] += s.queries[i];
    if (step.state.query) queries.resize(std::max<std::size_t>(queries.size(), *step.state.query + 1));
  }
  return p;
}

std::vector<Step> random_steps(Random& random) {
  std::vector<Step> steps;
  for (int i = 0; i < 30; ++i) {
    Step s;
    s.mesh = heap(random, random.below(4) == 0 ? 0 : 1 + random.below(12), random.below(2) == 0 ? 0.1 : 0.6);
    s.emits = random.below(5) == 0;
    if (random.below(2) == 0) s.state.query = static_cast<uint32_t>(random.below(4));
    if (random.below(2) == 0) {
      const DrawCondition condition{static_cast<uint32_t>(random.below(5)), random.below(2) == 0};
      if (s.state.query != condition.query) s.state.condition = condition;
    }
    if (random.below(3) == 0) s.state.color_mask = {false, false, false, false};
    if (random.below(3) == 0) s.state.depth.write = false;
    if (random.below(4) == 0) s.state.blend = kAdd;
    steps.push_back(std::move(s));
  }
  return steps;
}

TEST(Conditions, DrawIfASampleOfTheQueryHasPassed) {
  constexpr PassTuning kManyFlushes{.tile_size = 8, .chunk_triangles = 1, .bin_budget = 1};
  int skipped = 0, executed = 0;
  for (uint64_t seed = 0; seed < static_cast<uint64_t>(effort(60)); ++seed) {
    Random random(seed);
    const std::vector<Step> steps = random_steps(random);
    std::vector<uint64_t> queries;
    std::vector<bool> drawn;
    const Pictures expected = draw_one_by_one(steps, queries, drawn);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].state.condition) ++(drawn[i] ? executed : skipped);
    }
    for (const PassTuning& tuning : {PassTuning{}, kManyFlushes, PassTuning{.defer = false}}) {
      Pictures p;
      Pass pass(kWidth, kHeight, rgba32f_target(p.color), d32f_target(p.depth), {.tuning = tuning});
      for (const Step& step : steps) add(pass, step, step.state);
      const PassStatistics s = pass.run(two_workers());
      ASSERT_EQ(p.color, expected.color) << seed;
      ASSERT_EQ(p.depth, expected.depth) << seed;
      EXPECT_EQ(s.queries, queries) << seed;
    }
  }
  EXPECT_GT(skipped, 10);
  EXPECT_GT(executed, 10);
}

TEST(Conditions, WorkWithSeveralSamples) {
  for (const int samples : {2, 4, 8}) {
    for (const bool inverted : {false, true}) {
      Random random(7);
      const Mesh mesh = heap(random, 30, 0.6), probe = heap(random, 10, 0.3);
      Image<glm::vec4> image(kWidth, kHeight), expected(kWidth, kHeight);
      Pass pass(kWidth, kHeight, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = samples}),
          plain(kWidth, kHeight, rgba32f_target(expected), {.format = DepthFormat::d32f}, {.samples = samples});
      for (Pass* const each : {&pass, &plain}) {
        each->draw(SmoothColorShader{}, mesh.view());
        each->draw(SmoothColorShader{}, probe.view(), {.color_mask = {false, false, false, false}, .query = 3});
      }
      pass.draw(SmoothColorShader{}, probe.view(), {.depth = {.compare = CompareOp::always}, .condition = DrawCondition{3, inverted}});
      if (!inverted) plain.draw(SmoothColorShader{}, probe.view(), {.depth = {.compare = CompareOp::always}});
      PassStatistics s = pass.run(two_workers());
      const PassStatistics t = plain.run(one_worker());
      EXPECT_EQ(image, expected);
      EXPECT_EQ(s.flushes, 1u);
      EXPECT_EQ(s.vertices_in, t.vertices_in);
      EXPECT_EQ(s.primitives_in, t.primitives_in);
      EXPECT_EQ(s.samples_passed, t.samples_passed);
    }
  }
}

// Draws that wait for the same query do not flush again.
TEST(Conditions, FlushOnlyIfTheQueryHasNotBeenExecuted) {
  Random random(8);
  const Mesh mesh = heap(random, 5, 0.3);
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  pass.draw(SmoothColorShader{}, mesh.view(), {.condition = DrawCondition{0, true}});  // nothing to wait for
  pass.draw(SmoothColorShader{}, mesh.view(), {.query = 0});
  for (int i = 0; i < 4; ++i) pass.draw(SmoothColorShader{}, mesh.view(), {.condition = DrawCondition{0, i % 2 == 0}});
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s.flushes, 1u);
  EXPECT_EQ(s.primitives_in, 4u * 5u);
}

TEST(Conditions, ApplyToClears) {
  Random random(10);
  const Mesh mesh = heap(random, 5, 0.3);
  for (const bool inverted : {false, true}) {
    Image<glm::vec4> image(kWidth, kHeight);
    Pass pass(kWidth, kHeight, rgba32f_target(image), {});
    pass.draw(SmoothColorShader{}, mesh.view(), {.query = 1});
    pass.clear({.colors = {glm::vec4(0.5f)}, .condition = DrawCondition{1, inverted}});
    pass.run(one_worker());
    EXPECT_EQ(std::ranges::all_of(std::span(image.data(), kWidth * kHeight), [](const glm::vec4& c) { return c == glm::vec4(0.5f); }),
              !inverted);
  }
}

TEST(Conditions, ImpossibleOnesAreRefused) {
  Random random(9);
  const Mesh mesh = heap(random, 1, 0.3);
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  EXPECT_DEATH(pass.draw(SmoothColorShader{}, mesh.view(), {.query = 2, .condition = DrawCondition{2}}), "the query of the draw itself");
}

// ---- depth bounds ----------------------------------------------------------------------------------------------

struct Keeping : SmoothColorShader {
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color, MaskOf<R>(true)};
  }
};

TEST(DepthBounds, AreDepthsInAllFormats) {
  for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f, DepthFormat::d24s8, DepthFormat::d32fs8}) {
    for (const auto& [low, high, passes] :
         {std::tuple(0.2f, 0.6f, true), {0.5001f, 1.0f, false}, {0.0f, 0.4999f, false}, {0.49998f, 0.50002f, true}}) {
      Image<glm::vec4> image(kWidth, kHeight);
      Pass pass(kWidth, kHeight, rgba32f_target(image), {.format = format, .clear_value = 0.5f});
      const std::vector<glm::vec4> p = full_screen(-0.5f);
      pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.depth_bounds = StoredDepthRange{low, high}});
      EXPECT_EQ(pass.run(one_worker()).samples_passed, passes ? static_cast<uint64_t>(kWidth * kHeight) : 0u) << low << ' ' << high;
    }
  }
}

// The triangles of a draw do not overlap, so each fragment meets the depth from before the draw.
TEST(DepthBounds, PassFragmentsByTheStoredDepth) {
  Random random(11);
  const Mesh first = heap(random, 40, 0.6),
             second{{{-1, -1, -0.95f, 1}, {3, -1, -0.95f, 1}, {-1, 3, -0.95f, 1}}, std::vector(3, glm::vec4(2))};
  Pictures before;
  Pass prepare(kWidth, kHeight, rgba32f_target(before.color), d32f_target(before.depth));
  prepare.draw(SmoothColorShader{}, first.view());
  prepare.run(one_worker());
  for (const auto& [low, high] : {std::pair(0.2f, 0.6f), {0.0f, 1.0f}, {1.0f, 1.0f}, {0.5f, 0.5f}}) {
    for (const bool stencils : {false, true}) {
      for (const bool discards : {false, true}) {
        for (const bool blends : {false, true}) {
          for (const bool early : {false, true}) {
            Pictures p;
            const StencilFace count{.fail = StencilOp::invert, .depth_fail = StencilOp::invert, .pass = StencilOp::increment_clamp},
                one{.compare = CompareOp::equal, .reference = 1};
            DrawState state{.depth = {.test = !early}, .depth_bounds = StoredDepthRange{low, high}};
            if (stencils) state.stencil = StencilState{count, count};
            if (blends) state.blend = kReplace;
            std::vector<uint64_t> depth(std::size_t{kWidth} * kHeight);
            Pass pass(kWidth, kHeight, rgba32f_target(p.color), {.format = DepthFormat::d32fs8});
            pass.draw(SmoothColorShader{}, first.view());
            if (discards) {
              pass.draw(Keeping{}, second.view(), state);
            } else {
              pass.draw(SmoothColorShader{}, second.view(), state);
            }
            // Where the stencil was incremented, blue replaces the color.
            const ConstantShader blue({0, 0, 3, 1});
            if (stencils)
              pass.draw(blue, make_vertex_view(stream(second.positions)), {.depth = {.test = false}, .stencil = StencilState{one, one}});
            pass.run(two_workers());
            for (int i = 0; i < kWidth * kHeight; ++i) {
              const bool passes = before.depth.data()[i] >= low && before.depth.data()[i] <= high;
              const glm::vec4 drawn = stencils ? glm::vec4(0, 0, 3, 1) : glm::vec4(2);
              ASSERT_EQ(p.color.data()[i], passes ? drawn : before.color.data()[i]) << i << ' ' << stencils << discards << blends << early;
            }
          }
        }
      }
    }
  }
}

// Each fragment meets the depths of the fragments before it, whether or not the shader decides which of them are drawn.
TEST(DepthBounds, SeeTheFragmentsOfTheSameDraw) {
  Random random(12);
  const Mesh mesh = heap(random, 80, 0.5);
  for (const int samples : {1, 4}) {
    const auto picture = [&](auto shader, bool blends, const PassTuning& tuning) {
      Image<glm::vec4> image(kWidth, kHeight);
      Pass pass(kWidth, kHeight, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = samples, .tuning = tuning});
      DrawState state{.depth = {.compare = CompareOp::always}, .depth_bounds = StoredDepthRange{0.4f, 1.0f}};
      if (blends) state.blend = kReplace;
      pass.draw(shader, mesh.view(), state);
      pass.run(one_worker());
      return image;
    };
    const Image<glm::vec4> expected = picture(SmoothColorShader{}, false, {.chunk_triangles = 1, .bin_budget = 1});
    for (const bool blends : {false, true}) {
      EXPECT_EQ(picture(SmoothColorShader{}, blends, {}), expected);
      EXPECT_EQ(picture(Keeping{}, blends, {}), expected);
    }
  }
}

TEST(DepthBounds, HaveNoEffectWithoutADepthBuffer) {
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  const std::vector<glm::vec4> p = full_screen();
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.depth_bounds = StoredDepthRange{0.0f, 0.0f}});
  EXPECT_EQ(pass.run(one_worker()).samples_passed, static_cast<uint64_t>(kWidth * kHeight));
  EXPECT_DEATH(pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.depth_bounds = StoredDepthRange{0.5f, 0.25f}}),
               "depth_bounds: the range is empty");
}

// ---- records ---------------------------------------------------------------------------------------------------

TEST(DrawRecords, AreDrawsWithTheirParameters) {
  Random random(13);
  const Mesh mesh = heap(random, 40, 0.4);
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < 90; ++i) indices.push_back(static_cast<uint32_t>(random.below(60)));
  const Indices list(indices, 60);
  const std::vector<DrawRecord> records{{9, 1, 3, 0, 0}, {0, 1, 0, 0, 0}, {30, 2, 60, 20, 0}, {6, 0, 0, 0, 0}, {12, 1, 0, 60, 0}};
  for (const bool indexed : {false, true}) {
    Image<glm::vec4> image(kWidth, kHeight), expected(kWidth, kHeight);
    Pass pass(kWidth, kHeight, rgba32f_target(image), {}), plain(kWidth, kHeight, rgba32f_target(expected), {});
    const DrawState state{.first = 1000, .blend = kAdd};  // the fields of the records replace those of the state
    if (indexed) {
      pass.draw_records(SmoothColorShader{}, mesh.view(), list, records, state);
    } else {
      pass.draw_records(SmoothColorShader{}, mesh.view(), std::span(records).first(4), state);
    }
    for (const DrawRecord& r : std::span(records).first(indexed ? 5 : 4)) {
      const DrawState own{.first = r.first, .count = r.count, .base_vertex = r.base_vertex, .instances = r.instances, .blend = kAdd};
      if (indexed) {
        plain.draw(SmoothColorShader{}, mesh.view(), list, own);
      } else {
        plain.draw(SmoothColorShader{}, mesh.view(), own);
      }
    }
    EXPECT_EQ(pass.run(one_worker()), plain.run(one_worker()));
    EXPECT_EQ(image, expected);
  }
}

// ---- timers ----------------------------------------------------------------------------------------------------

TEST(Timers, DivideTheTimeOfDrawsByStage) {
  Random random(14);
  const Mesh mesh = heap(random, 400, 0.2);
  for (const bool defers : {false, true}) {
    for (const int samples : {1, 4}) {
      Image<glm::vec4> image(kWidth, kHeight);
      Pass pass(kWidth, kHeight, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = samples, .tuning = {.defer = defers}});
      pass.draw(SmoothColorShader{}, mesh.view(), {.timer = 2});
      pass.draw_depth(SmoothColorShader{}, mesh.view(), {.timer = 0});
      pass.draw(SmoothColorShader{}, mesh.view());
      pass.draw(Doubling{}, mesh.view(), {.timer = 3});
      const PassStatistics s = pass.run(two_workers());
      ASSERT_EQ(s.times.size(), 4u);
      EXPECT_EQ(s.times[1], DrawTime{});
      EXPECT_GT(s.times[0].setup, 0.0);
      EXPECT_GT(s.times[0].visibility, 0.0);
      EXPECT_EQ(s.times[0].shading, 0.0);
      for (const std::size_t i : {2u, 3u}) {
        EXPECT_GT(s.times[i].setup, 0.0);
        EXPECT_GT(s.times[i].visibility, 0.0);
        EXPECT_GT(s.times[i].shading, 0.0) << i << ' ' << defers << ' ' << samples;
      }
    }
  }
}

TEST(Timers, AreAbsentWithoutOne) {
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  const std::vector<glm::vec4> p = full_screen();
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)));
  EXPECT_TRUE(pass.run(one_worker()).times.empty());
}

}  // namespace
}  // namespace halfspace::raster_test::draw_conditions_test
