// SPDX-License-Identifier: Apache-2.0
//
// Tests what shaders promise about their tests and depths: early tests and conservative depth.
#include "raster/raster_test.h"

namespace halfspace::raster_test::fragment_promises_test {
namespace {

constexpr int kSize = 48;

// Discards the left half, and returns a depth.
template <bool early>
struct HalfShader : PositionShader {
  static constexpr bool early_fragment_tests = early;
  glm::vec4 color{1.0f};
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w)), px.x > R(kSize / 2.0f), R(0.125f)};
  }
};

struct Result {
  Image<glm::vec4> color{kSize, kSize};
  Image<float> depth{kSize, kSize};
  PassStatistics statistics;
};

std::vector<glm::vec4> heap(uint64_t seed, int triangles) {
  Random random(seed);
  std::vector<glm::vec4> p;
  for (int i = 0; i < 3 * triangles; ++i) {
    const auto value = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    const float w = value(0.5, 2);
    p.push_back(glm::vec4(value(-1, 1), value(-1, 1), value(-0.9, 0.9), 1) * w);
  }
  return p;
}

template <class S>
Result draw(const S& shader, const std::vector<glm::vec4>& p, const DrawState& state, int samples) {
  Result r;
  Pass pass(kSize, kSize, rgba32f_target(r.color), d32f_target(r.depth), {.samples = samples});
  pass.draw(shader, make_vertex_view(stream(p)), state);
  r.statistics = pass.run(two_workers());
  return r;
}

// Depth, stencil and queries are those of a shader that draws everything, and colors are missing where the shader discards.
TEST(EarlyTests, PrecedeTheShader) {
  const std::vector<glm::vec4> p = heap(5, 40);
  for (const int samples : {1, 4}) {
    for (const bool each_sample : {false, true}) {
      for (const bool blends : {false, true}) {
        DrawState state{.sample_shading = each_sample, .query = 0};
        if (blends) state.blend = kAdd;
        const Result early = draw(HalfShader<true>{}, p, state, samples), whole = draw(ConstantShader{}, p, state, samples),
                     late = draw(HalfShader<false>{}, p, state, samples);
        EXPECT_EQ(early.depth, whole.depth);
        EXPECT_EQ(early.statistics.queries, whole.statistics.queries);
        EXPECT_FALSE(late.depth == whole.depth);
        EXPECT_LT(late.statistics.queries[0], whole.statistics.queries[0]);
        for (int y = 0; y < kSize; ++y) {
          for (int x = 0; x < kSize; ++x)
            ASSERT_EQ(pixel(early.color, x, y), x < kSize / 2 ? glm::vec4(0) : pixel(whole.color, x, y)) << x << ' ' << y;
        }
      }
    }
  }
}

// A discarded fragment leaves the color behind it but hides what is drawn later.
TEST(EarlyTests, DiscardedFragmentsHideLaterOnes) {
  for (const int samples : {1, 4}) {
    Image<glm::vec4> image(kSize, kSize);
    Image<float> depth(kSize, kSize);
    Pass pass(kSize, kSize, rgba32f_target(image), d32f_target(depth), {.samples = samples});
    const std::vector<glm::vec4> back = full_screen(0.5f), middle = full_screen(0.0f), between = full_screen(0.25f);
    pass.draw(ConstantShader{{0, 0, 1, 1}}, make_vertex_view(stream(back)));
    pass.draw(HalfShader<true>{}, make_vertex_view(stream(middle)));
    pass.draw(ConstantShader{{1, 0, 0, 1}}, make_vertex_view(stream(between)));
    pass.run(one_worker());
    for (int x = 0; x < kSize; ++x) EXPECT_EQ(pixel(image, x, 7), x < kSize / 2 ? glm::vec4(0, 0, 1, 1) : glm::vec4(1));
  }
}

TEST(EarlyTests, UpdateStencilValuesOfDiscardedFragments) {
  Image<glm::vec4> image(kSize, kSize);
  std::vector<uint64_t> stored(std::size_t{kSize} * kSize);
  const StencilFace count{.pass = StencilOp::increment_clamp}, only_one{.compare = CompareOp::equal, .reference = 1};
  Pass pass(kSize, kSize, rgba32f_target(image), {.format = DepthFormat::d32fs8});
  const std::vector<glm::vec4> p = full_screen();
  pass.draw(HalfShader<true>{}, make_vertex_view(stream(p)), {.stencil = StencilState{count, count}});
  pass.draw(ConstantShader{{0, 1, 0, 1}}, make_vertex_view(stream(p)),
            {.depth = {.test = false}, .stencil = StencilState{only_one, only_one}});
  pass.run(one_worker());
  for (int x = 0; x < kSize; ++x) EXPECT_EQ(pixel(image, x, 3), glm::vec4(0, 1, 0, 1)) << x;
}

TEST(EarlyTests, DepthOnlyDrawsIgnoreTheShader) {
  Result early;
  Pass pass(kSize, kSize, rgba32f_target(early.color), d32f_target(early.depth));
  const std::vector<glm::vec4> p = heap(9, 20);
  pass.draw_depth(HalfShader<true>{}, make_vertex_view(stream(p)));
  pass.run(one_worker());
  EXPECT_EQ(early.depth, draw(ConstantShader{}, p, {}, 1).depth);
}

// Returns a depth that is `shift` behind that of the primitive, which is 0, positive or negative in some pixels, as promised.
template <ConservativeDepth bound>
struct ShiftedShader : PositionShader {
  static constexpr ConservativeDepth conservative_depth = bound;
  float shift = 0.0f;
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const R moved = px.z() + select(px.x > R(kSize / 3.0f), R(shift), R(0));
    return {vec4<R>(px.x, px.y, moved, R(1)), px.y < R(kSize - 3.0f), moved};
  }
};

template <ConservativeDepth bound>
void expect_like_without_promise(float shift) {
  const std::vector<glm::vec4> p = heap(12, 60);
  for (const CompareOp op : {CompareOp::less, CompareOp::less_equal, CompareOp::greater, CompareOp::greater_equal, CompareOp::not_equal,
                             CompareOp::always, CompareOp::equal, CompareOp::never}) {
    for (const int samples : {1, 4}) {
      for (const bool blends : {false, true}) {
        for (const bool each_sample : {false, true}) {
          DrawState state{.depth = {.compare = op}, .sample_shading = each_sample};
          if (blends) state.blend = kAdd;
          const Result promised = draw(ShiftedShader<bound>{{}, shift}, p, state, samples),
                       any = draw(ShiftedShader<ConservativeDepth::any>{{}, shift}, p, state, samples);
          // Where the shader returns Pixel::z(), the promise replaces it by the depth of the primitive, from which it can differ by the
          // rounding of both, 2^-23. Such a difference can decide a test between two fragments of nearly equal depth; 4 pixels may be such.
          int differing = 0;
          for (int i = 0; i < kSize * kSize; ++i) differing += std::fabs(promised.depth.data()[i] - any.depth.data()[i]) > 0x1p-23f ? 1 : 0;
          EXPECT_LE(differing, 4) << static_cast<int>(op) << ' ' << samples << ' ' << blends;
          if (blends) {
            EXPECT_LE(promised.statistics.fragments_shaded, any.statistics.fragments_shaded);
          }
        }
      }
    }
  }
}

TEST(ConservativeDepth, PromisesDoNotChangeThePicture) {
  expect_like_without_promise<ConservativeDepth::greater>(0.0625f);
  expect_like_without_promise<ConservativeDepth::less>(-0.0625f);
}

TEST(ConservativeDepth, RejectsFragmentsBeforeTheyAreShaded) {
  const std::vector<glm::vec4> p = heap(13, 60);
  const auto shaded = [&]<ConservativeDepth bound>() {
    Result r;
    Pass pass(kSize, kSize, rgba32f_target(r.color), d32f_target(r.depth));
    const std::vector<glm::vec4> front = full_screen(-0.95f);
    pass.draw(ConstantShader{}, make_vertex_view(stream(front)));
    pass.draw(ShiftedShader<bound>{{}, 0.0f}, make_vertex_view(stream(p)), {.blend = kAdd});
    return pass.run(one_worker()).fragments_shaded - static_cast<uint64_t>(kSize * kSize);
  };
  EXPECT_EQ(shaded.template operator()<ConservativeDepth::greater>(), 0u);
  EXPECT_GT(shaded.template operator()<ConservativeDepth::any>(), 1000u);
}

struct Kept : PositionShader {
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(px.x, px.y, R(0), R(1)), px.y < R(kSize - 3.0f)};
  }
};

TEST(ConservativeDepth, UnchangedDepthsAreThoseOfThePrimitive) {
  const std::vector<glm::vec4> p = heap(14, 40);
  const Result r = draw(ShiftedShader<ConservativeDepth::unchanged>{{}, 0.5f}, p, {}, 1), expected = draw(Kept{}, p, {}, 1);
  EXPECT_EQ(r.depth, expected.depth);
  EXPECT_EQ(r.statistics.samples_passed, expected.statistics.samples_passed);
}

#ifdef HALFSPACE_ASSERTS
TEST(ConservativeDepth, ADepthOnTheWrongSideFailsACheck) {
  const std::vector<glm::vec4> p = full_screen();
  EXPECT_DEATH(draw(ShiftedShader<ConservativeDepth::greater>{{}, -0.25f}, p, {}, 1), "check failed");
}
#else
TEST(ConservativeDepth, DepthsOnTheWrongSideAreLimited) {
  const std::vector<glm::vec4> p = full_screen();
  const Result r = draw(ShiftedShader<ConservativeDepth::greater>{{}, -0.25f}, p, {}, 1);
  for (int x = 0; x < kSize; ++x) EXPECT_EQ(pixel(r.depth, x, 5), 0.5f);
}
#endif

}  // namespace
}  // namespace halfspace::raster_test::fragment_promises_test
