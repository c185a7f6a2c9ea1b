// SPDX-License-Identifier: Apache-2.0
//
// Traces small passes for which the outcome of every fragment is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "halfspace/raster/inspect/inspection.h"
#include "support/random.h"
#include "support/shaders.h"
#include "support/workers.h"

namespace halfspace {

namespace {

constexpr int kSize = 64;

using Corners = std::vector<glm::vec4>;

// A triangle that covers the whole target, and a triangle with edges inside the target. The window depth is z / 2 + 1 / 2.
Corners whole(float z) { return {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}}; }
Corners part(float z) { return {{-0.9f, -0.9f, z, 1}, {0.9f, -0.9f, z, 1}, {-0.9f, 0.9f, z, 1}}; }

// Two small triangles of one draw. Both fit into a queue, for any number of lanes.
Corners two_small(float z0, float z1) {
  Corners corners;
  for (const float z : {z0, z1}) corners.insert(corners.end(), {{-0.05f, -0.05f, z, 1}, {0.1f, -0.05f, z, 1}, {-0.05f, 0.1f, z, 1}});
  return corners;
}

// Discards or keeps all fragments, either in the fragment function or in the visibility function.
template <bool early, bool keeps = false>
struct DiscardingShader : PositionShader {
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1)), MaskOf<R>(keeps)};
  }
  template <class R>
  requires early Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px)
  const { return {MaskOf<R>(keeps), px.z()}; }
};

// A pass, its image and its trace.
struct Traced {
  explicit Traced(int samples = 1, DepthFormat depth = DepthFormat::d32f)
      : image(kSize, kSize), pass(kSize, kSize, rgba32f_target(image), {.format = depth}, {.samples = samples}) {}

  template <class S>
  void draw(const S& shader, const Corners& corners, const DrawState& state = {}) {
    kept.push_back(std::make_unique<Corners>(corners));
    pass.draw(shader, make_vertex_view(stream(*kept.back())), state);
  }
  void run() { statistics = run_traced(pass, one_worker(), trace); }

  // Returns the fragments of a pixel. x and y are counted from the lower left.
  std::vector<TracedFragment> at(int x, int y) const {
    std::vector<TracedFragment> out;
    for (const std::vector<TileFragments>& tiles : trace.rounds) {
      for (const TileFragments& t : tiles) {
        if (t.first.empty() || x < t.x0 || y < t.y0 || x >= t.x0 + t.width || y >= t.y0 + t.height) continue;
        const auto i = static_cast<std::size_t>((y - t.y0) * t.width + x - t.x0);
        out.insert(out.end(), t.fragments.begin() + t.first[i], t.fragments.begin() + t.first[i + 1]);
      }
    }
    return out;
  }
  std::vector<FragmentOutcome> outcomes(int x, int y) const {
    std::vector<FragmentOutcome> out;
    for (const TracedFragment& f : at(x, y)) out.push_back(f.outcome);
    return out;
  }

  Image<glm::vec4> image;
  Pass pass;
  PassTrace trace;
  PassStatistics statistics;
  std::vector<std::unique_ptr<Corners>> kept;
};

using enum FragmentOutcome;
using Outcomes = std::vector<FragmentOutcome>;

constexpr glm::vec4 kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1};

TEST(PassTrace, FrontToBackRejectsTheFarTriangleWithItsBlocks) {
  Traced t;
  t.draw(ConstantShader(kRed), part(-0.5f));
  t.draw(ConstantShader(kGreen), part(0.5f));
  t.run();
  // a block that the near triangle covers completely has exact bounds
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{shaded, block_rejected}));
  const std::vector<TracedFragment> f = t.at(10, 10);
  EXPECT_EQ(f[0].depth, 0.25f);
  EXPECT_EQ(f[0].stored_depth, 1.0f);
  EXPECT_EQ(f[0].value, kRed);
  EXPECT_EQ(f[1].depth, 0.75f);
  EXPECT_EQ(f[1].tested_depth, 0.75f);
  EXPECT_EQ(f[1].stored_depth, 0.25f);
  EXPECT_FALSE(f[1].is_shaded);
  // a block at the diagonal edge still contains depth 1, so its samples are tested
  EXPECT_EQ(t.outcomes(40, 20), (Outcomes{shaded, depth_failed}));
  EXPECT_TRUE(t.outcomes(60, 60).empty());
}

TEST(PassTrace, BackToFrontHidesTheFarTriangleBeforeShading) {
  Traced t;
  t.draw(ConstantShader(kRed), part(0.5f));
  t.draw(ConstantShader(kGreen), part(-0.5f));
  t.run();
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{hidden_before_shading, shaded}));
  EXPECT_EQ(t.at(10, 10)[1].stored_depth, 0.75f);
  EXPECT_EQ(t.at(10, 10)[0].draw, 0u);
  EXPECT_EQ(t.at(10, 10)[1].draw, 1u);
}

TEST(PassTrace, PendingFullTileTrianglesAreReplacedWithoutBeingWritten) {
  Traced t;
  t.draw(ConstantShader(kRed), whole(0.5f));
  t.draw(ConstantShader(kGreen), whole(-0.5f));
  t.draw(ConstantShader(kRed), part(0.0f));
  t.run();
  EXPECT_EQ(t.outcomes(3, 60), (Outcomes{hidden_before_shading, shaded}));
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{hidden_before_shading, shaded, tile_rejected}));
  const std::vector<TracedFragment> f = t.at(10, 10);
  EXPECT_EQ(f[1].stored_depth, 0.75f);  // depth of the previous triangle, although it was never written
  EXPECT_EQ(f[2].tested_depth, 0.5f);
  EXPECT_EQ(f[2].stored_depth, 0.25f);
  EXPECT_EQ(t.image.at(10, 10), kGreen);
}

TEST(PassTrace, BlendedFragmentsAreShadedInOrder) {
  Traced t;
  t.draw(ConstantShader(kRed), whole(0.5f));
  t.draw(ConstantShader({0, 1, 0, 0.5f}), part(0.0f), kAlphaBlendState);
  t.run();
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{shaded, blended}));
  EXPECT_EQ(t.at(10, 10)[1].color, glm::vec4(0, 1, 0, 0.5f));
  EXPECT_EQ(t.at(10, 10)[1].value, t.image.at(10, kSize - 1 - 10));
  EXPECT_EQ(t.at(10, 10)[1].value, glm::vec4(0.5f, 0.5f, 0, 1));
  EXPECT_TRUE(t.at(10, 10)[1].is_shaded);
}

TEST(PassTrace, DiscardedFragmentsAreShadedOnlyWithoutAVisibilityFunction) {
  Traced t;
  t.draw(DiscardingShader<false>(), part(0.0f));
  t.draw(DiscardingShader<true>(), part(0.0f));
  t.run();
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{discarded, discarded}));
  EXPECT_TRUE(t.at(10, 10)[0].is_shaded);
  EXPECT_FALSE(t.at(10, 10)[1].is_shaded);
}

TEST(PassTrace, QueuedTrianglesAreBlendedOneAfterAnother) {
  Traced t;
  t.draw(ConstantShader({1, 0, 0, 0.5f}), two_small(0.5f, 0.0f), kAlphaBlendState);
  t.run();
  const std::vector<TracedFragment> f = t.at(31, 31);
  EXPECT_EQ(t.outcomes(31, 31), (Outcomes{blended, blended}));
  EXPECT_EQ(f[0].primitive, 0u);
  EXPECT_EQ(f[0].value.x, 0.5f);
  EXPECT_EQ(f[1].primitive, 1u);
  EXPECT_EQ(f[1].value.x, 0.75f);
}

TEST(PassTrace, QueuedFragmentsCanFailAfterTheyWereShaded) {
  Traced t;
  t.draw(DiscardingShader<false, true>(), two_small(-0.5f, 0.0f));
  t.run();
  const std::vector<TracedFragment> f = t.at(31, 31);
  EXPECT_EQ(t.outcomes(31, 31), (Outcomes{shaded, depth_failed}));
  EXPECT_EQ(f[0].stored_depth, 1.0f);
  EXPECT_TRUE(f[1].is_shaded);
  EXPECT_EQ(f[1].tested_depth, 0.5f);
  EXPECT_EQ(f[1].stored_depth, 0.25f);  // depth of the previous triangle in the queue
}

TEST(PassTrace, QueuedFragmentsThatAVisibilityFunctionKeepsAreTestedInOrder) {
  Traced nearer_first, farther_first;
  nearer_first.draw(DiscardingShader<true, true>(), two_small(-0.5f, 0.0f));
  farther_first.draw(DiscardingShader<true, true>(), two_small(0.0f, -0.5f));
  nearer_first.run();
  farther_first.run();
  EXPECT_EQ(nearer_first.outcomes(31, 31), (Outcomes{shaded, depth_failed}));
  EXPECT_EQ(nearer_first.at(31, 31)[1].stored_depth, 0.25f);
  EXPECT_FALSE(nearer_first.at(31, 31)[1].is_shaded);
  EXPECT_EQ(farther_first.outcomes(31, 31), (Outcomes{hidden_before_shading, shaded}));
}

TEST(PassTrace, QueuedLayersAllTakeTheValueAfterBlending) {
  Traced t;
  t.draw(ConstantShader({0, 1, 0, 0.5f}), two_small(-0.5f, 0.0f), {.depth = {.write = false}, .order_independent = true});
  t.run();
  EXPECT_EQ(t.outcomes(31, 31), (Outcomes{layered, layered}));
  for (const TracedFragment& f : t.at(31, 31)) EXPECT_EQ(f.value, t.image.at(31, kSize - 1 - 31));
  EXPECT_EQ(t.image.at(31, kSize - 1 - 31).y, 0.75f);
}

TEST(PassTrace, StencilFailuresComeBeforeDepthFailures) {
  Traced t(1, DepthFormat::d32fs8);
  const StencilFace never{.compare = CompareOp::never}, always{.compare = CompareOp::always};
  t.draw(ConstantShader(kRed), part(0.0f), {.stencil = StencilState{never, never}});
  t.draw(ConstantShader(kRed), part(0.0f), {.stencil = StencilState{always, always}});
  t.draw(ConstantShader(kRed), part(0.5f), {.stencil = StencilState{always, always}});
  t.run();
  // The stencil is kept, so blocks may be rejected as a whole, but not this block at the edge.
  EXPECT_EQ(t.outcomes(40, 20), (Outcomes{stencil_failed, shaded, depth_failed}));
}

TEST(PassTrace, LayersTakeTheValueAfterAllWereBlended) {
  constexpr DrawState layered_state{.depth = {.write = false}, .order_independent = true};
  Traced t;
  t.draw(ConstantShader(kRed), whole(0.5f));
  t.draw(ConstantShader({0, 1, 0, 0.5f}), part(-0.5f), layered_state);
  t.draw(ConstantShader({0, 0, 1, 0.5f}), part(0.0f), layered_state);
  t.run();
  EXPECT_EQ(t.outcomes(10, 10), (Outcomes{shaded, layered, layered}));
  EXPECT_EQ(t.at(10, 10)[1].value, t.image.at(10, kSize - 1 - 10));
  EXPECT_EQ(t.at(10, 10)[2].value, t.image.at(10, kSize - 1 - 10));
}

TEST(PassTrace, MoreThanEightLayersAreMerged) {
  constexpr DrawState layered_state{.depth = {.write = false}, .order_independent = true};
  Traced t;
  for (int i = 0; i < 9; ++i) t.draw(ConstantShader({0, 1, 0, 0.5f}), part(0.0f), layered_state);
  t.run();
  Outcomes want(9, layered);
  want.back() = layer_merged;
  EXPECT_EQ(t.outcomes(10, 10), want);
}

TEST(PassTrace, SamplesOfAnEdgePixelHaveTheirOwnFragments) {
  Traced t(4);
  t.draw(ConstantShader(kRed), whole(0.5f));
  t.draw(ConstantShader(kGreen), part(0.0f));
  t.run();
  int edge_pixels = 0;
  for (int x = 0; x < kSize; ++x) {
    std::array<int, 2> shaded_samples{};
    for (const TracedFragment& f : t.at(x, 31)) {
      if (f.outcome != shaded) continue;
      ++shaded_samples[f.draw];
      EXPECT_EQ(t.trace.values[static_cast<std::size_t>(((kSize - 1 - 31) * kSize + x) * 4 + f.sample)], f.value);
    }
    EXPECT_EQ(shaded_samples[0] + shaded_samples[1], 4) << x;
    edge_pixels += shaded_samples[0] != 0 && shaded_samples[1] != 0 ? 1 : 0;
  }
  EXPECT_GE(edge_pixels, 1);
}

TEST(PassTrace, DepthOnlyDrawsLeaveColorUnchanged) {
  Traced t;
  t.draw(ConstantShader(kRed), part(0.0f), kDepthOnlyState);
  t.run();
  EXPECT_EQ(t.outcomes(10, 10), Outcomes{depth_only});
}

// Returns three triangles near a random point, all of a similar random size.
Corners random_corners(Random& random) {
  const float size = random.real(0.02f, 1.5f);
  const glm::vec2 at(random.real(-1, 1), random.real(-1, 1));
  Corners corners;
  for (int k = 0; k < 9; ++k)
    corners.emplace_back(at.x + size * random.real(-1, 1), at.y + size * random.real(-1, 1), random.real(-0.9f, 1.2f), 1.0f);
  return corners;
}

// Random triangles of all sizes, with several kinds of draws.
void draw_random(Traced& t, uint32_t seed) {
  Random random(seed);
  constexpr StencilFace only_zero{.compare = CompareOp::equal};  // keeps the stencil values
  constexpr StencilFace increment{.depth_fail = StencilOp::increment_clamp, .pass = StencilOp::increment_clamp};
  for (int i = 0; i < 60; ++i) {
    const Corners corners = random_corners(random);
    const glm::vec4 color(random.real(0, 1), random.real(0, 1), random.real(0, 1), random.real(0.2f, 1));
    t.draw(ConstantShader(color), corners,
           i % 5 == 3    ? kAlphaBlendState
           : i % 7 == 3  ? DrawState{.depth = {.write = false}, .order_independent = true}
           : i % 11 == 4 ? DrawState{.stencil = StencilState{increment, increment}}
           : i % 3 == 1  ? DrawState{.stencil = StencilState{only_zero, only_zero}}
                         : DrawState{});
  }
}

// The last fragment that changed a sample has the value that the sample has at the end of the pass.
void expect_last_values(const Traced& t, int samples) {
  int compared = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      std::map<int, glm::vec4> last;
      for (const TracedFragment& f : t.at(x, y)) {
        if (f.outcome >= shaded) last[f.sample] = f.value;
      }
      const int pixel = (kSize - 1 - y) * kSize + x;
      for (const auto& [sample, value] : last) EXPECT_EQ(value, t.trace.values[static_cast<std::size_t>(pixel * samples + sample)]);
      compared += static_cast<int>(last.size());
    }
  }
  EXPECT_GE(compared, kSize * kSize / 2);
}

TEST(PassTrace, CountsMatchTheStatisticsAndTheImage) {
  for (const int samples : {1, 4}) {
    Traced traced(samples, DepthFormat::d32fs8), plain(samples, DepthFormat::d32fs8);
    draw_random(traced, 5);
    draw_random(plain, 5);
    traced.run();
    const PassStatistics want = plain.pass.run(one_worker());
    EXPECT_EQ(traced.statistics, want);
    EXPECT_TRUE(std::ranges::equal(traced.image.texels(), plain.image.texels()));
    expect_last_values(traced, samples);
    uint64_t rejected = 0, all = 0, failed = 0, failed_stencil = 0;
    for (const TileFragments& tile : traced.trace.rounds[0]) {
      for (const TracedFragment& f : tile.fragments) {
        ++all;
        rejected += f.outcome == tile_rejected || f.outcome == block_rejected ? 1 : 0;
        failed += f.outcome == depth_failed ? 1 : 0;
        failed_stencil += f.outcome == stencil_failed ? 1 : 0;
      }
    }
    EXPECT_EQ(all - rejected, want.samples_tested);
    EXPECT_EQ(all - rejected - failed - failed_stencil, want.samples_passed);
    EXPECT_GT(failed_stencil, 0u);
  }
}

TEST(PassTrace, EverySampleOfAHiddenPointHasAFragment) {
  Traced t(4);
  t.draw(ConstantShader(kRed), whole(-0.5f));
  t.draw(ConstantShader(kRed), part(-0.6f));  // the full-tile triangle is written
  DrawState points = kAlphaBlendState;
  points.topology = Topology::points;
  points.point_size = 40.0f;
  t.draw(ConstantShader(kGreen), {{0, 0, 0.5f, 1}}, points);
  t.run();
  int rejected = 0;
  for (const FragmentOutcome outcome : t.outcomes(30, 30)) rejected += outcome == block_rejected ? 1 : 0;
  EXPECT_EQ(rejected, 4);
}

TEST(PassTrace, EveryCoveredSampleHasAFragment) {
  // Without a depth test, nothing is rejected and all covered samples are listed.
  for (const int samples : {1, 4}) {
    Traced tested(samples, DepthFormat::d32fs8);
    draw_random(tested, 9);
    tested.run();
    uint64_t all = 0;
    for (const TileFragments& tile : tested.trace.rounds[0]) all += tile.fragments.size();
    Random random(9);
    Traced open(samples);
    for (int i = 0; i < 60; ++i) {
      const Corners corners = random_corners(random);
      for (int k = 0; k < 4; ++k) (void)random.real(0, 1);  // skips the color of draw_random()
      open.draw(ConstantShader(kRed), corners, {.depth = {.test = false}});
    }
    open.run();
    EXPECT_EQ(all, open.statistics.samples_tested) << samples << " samples";
  }
}

}  // namespace

}  // namespace halfspace
