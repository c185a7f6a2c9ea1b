// SPDX-License-Identifier: Apache-2.0
//
// Checks the choice of the example pixel in all shipped scenes, at three sizes.
#include "explain/example_pixel.h"

#include <gtest/gtest.h>

#include <array>

#include "explain/prepared.h"
#include "support/expected_hash.h"
#include "support/hash.h"

namespace halfspace {
namespace {

constexpr std::array kSizes{glm::ivec2(96, 54), glm::ivec2(160, 90), glm::ivec2(320, 180)};

struct Choice {
  glm::ivec2 pixel{};
  ExampleFacts facts;
  ExampleIdeas ideas;
  // Whether any pixel of the frame has a triangle, one of the right size, or is ideal.
  bool any_triangle = false, any_size = false, any_ideal = false;
};

bool has_size(const ExampleFacts& f) {
  return f.is_triangle && !f.is_clipped && f.visible_pixels >= 10 && f.covered_pixels <= 2000 && f.height >= 4.0;
}

// The requirements of the page, independent of the scores.
bool is_ideal(const ExampleFacts& f, const ExampleIdeas& ideas) {
  return has_size(f) && f.primitives >= 2 && (!ideas.light || (f.cosine > 0.2f && f.cosine < 0.9f)) &&
         (!ideas.perspective || f.affine_error >= 0.5) && (!ideas.shadow || (f.shadow >= 0.35f && f.shadow <= 0.65f));
}

Choice choice_of(const std::string& scene, glm::ivec2 size, int threads) {
  const PreparedText s(SceneFile::open(scene).at(0.0), size.x, size.y, threads);
  const FrameTrace trace = trace_frame(s.prepared, s.workers);
  const ValuePictures values = value_pictures(s.prepared, s.workers);
  Choice out;
  visit_set_up_scene(s.prepared, s.workers, [&](const PassContext& context, int round) {
    if (round > 0) return;
    const ExampleSearch search({s.prepared, context, trace, values, s.workers});
    out.pixel = search.best();
    out.facts = search.facts(out.pixel);
    out.ideas = search.ideas();
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const ExampleFacts f = search.facts({x, y});
        out.any_triangle |= f.is_triangle;
        out.any_size |= has_size(f);
        out.any_ideal |= is_ideal(f, out.ideas);
      }
    }
  });
  return out;
}

// The hash of the chosen pixels is the same for every SIMD width and processor.
TEST(Example, AllShippedScenesHaveAGoodOne) {
  Hash hash;
  for (const ShippedScene& shipped : shipped_scenes()) {
    for (const glm::ivec2 size : kSizes) {
      const Choice c = choice_of(std::string(shipped.name), size, 2);
      const std::string where = std::string(shipped.name) + " " + std::to_string(size.x);
      EXPECT_EQ(c.facts.is_triangle, c.any_triangle) << where;
      EXPECT_EQ(has_size(c.facts), c.any_size) << where << ": " << c.facts.visible_pixels << " of " << c.facts.covered_pixels;
      if (c.any_ideal) {
        EXPECT_TRUE(is_ideal(c.facts, c.ideas)) << where << " at " << c.pixel.x << "," << c.pixel.y;
      }
      hash.add(static_cast<uint64_t>(c.pixel.x));
      hash.add(static_cast<uint64_t>(c.pixel.y));
    }
  }
  expect_hash("example-pixels", hash.value());
}

// The scene of the documentation shows every idea at every size.
TEST(Example, PipelineShowsEverything) {
  for (const glm::ivec2 size : kSizes) {
    const Choice c = choice_of("pipeline", size, 2);
    EXPECT_TRUE(c.ideas.light && c.ideas.perspective && c.ideas.shadow && c.ideas.samples);
    EXPECT_TRUE(is_ideal(c.facts, c.ideas)) << size.x << ": " << c.pixel.x << "," << c.pixel.y;
  }
}

TEST(Example, DoesNotDependOnThreads) {
  for (const char* scene : {"pipeline", "day-night", "particles"})
    EXPECT_EQ(choice_of(scene, {96, 54}, 1).pixel, choice_of(scene, {96, 54}, 3).pixel) << scene;
}

// Between 1/w = 1 and 1/w = 1/4, interpolation along an edge of 300 pixels differs most by a third of it: √1 − √¼ over √1 + √¼.
TEST(Example, TheErrorOfAffineInterpolationHasAClosedForm) {
  const std::array<int32_t, 3> x{0, 300 * kSubPixels, 0}, y{0, 0, 0};
  EXPECT_DOUBLE_EQ(affine_error(x, y, {1.0f, 0.25f, 1.0f}), 100.0);
  EXPECT_EQ(affine_error(x, y, {0.5f, 0.5f, 0.5f}), 0.0);
}

// Each fact that the frame can show raises the score, and a fact about an idea that it cannot show does not.
TEST(Example, EachFactCountsIfTheFrameShowsItsIdea) {
  const ExampleFacts plain{.is_triangle = true, .visible_pixels = 50, .covered_pixels = 60, .primitives = 1, .height = 8.0};
  const ExampleIdeas all{.perspective = true, .light = true, .shadow = true, .samples = true};
  const auto with = [&](const auto& set) {
    ExampleFacts f = plain;
    set(f);
    return f;
  };
  const ExampleFacts better[] = {with([](ExampleFacts& f) { f.affine_error = 0.6; }), with([](ExampleFacts& f) { f.cosine = 0.5f; }),
                                 with([](ExampleFacts& f) { f.shadow = 0.5f; }),
                                 with([](ExampleFacts& f) { f.has_different_samples = true; })};
  for (const ExampleFacts& f : better) {
    EXPECT_GT(example_score(f, all), example_score(plain, all));
    EXPECT_EQ(example_score(f, {}), example_score(plain, {}));
  }
  EXPECT_GT(example_score(with([](ExampleFacts& f) { f.primitives = 3; }), {}), example_score(plain, {}));
  EXPECT_GT(example_score(plain, {}), example_score(with([](ExampleFacts& f) { f.visible_pixels = 1; }), {}));
  EXPECT_GT(example_score(plain, {}), example_score(with([](ExampleFacts& f) { f.covered_pixels = 50000; }), {}));
  EXPECT_GT(example_score(plain, {}), example_score(with([](ExampleFacts& f) { f.height = 1.0; }), {}));
  EXPECT_GT(example_score(plain, {}), example_score(with([](ExampleFacts& f) { f.is_clipped = true; }), {}));
}

}  // namespace
}  // namespace halfspace
