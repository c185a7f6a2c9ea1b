// SPDX-License-Identifier: Apache-2.0
//
// A pass distributes its work to threads: large draws are split, small draws are combined, and chunks grow. None of this may affect the
// result.
#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int kDrawsSize = 96;

struct Primitives {
  Topology topology;
  std::size_t corners;  ///< vertices per primitive
  std::vector<glm::vec4> positions{}, colors{};

  std::size_t count() const { return positions.size() / corners; }
};

// Returns small overlapping primitives whose order is visible in every pixel. Every fiftieth has a vertex behind the eye.
Primitives many(Topology topology, std::size_t corners, int count) {
  Random random(31);
  Primitives p{topology, corners};
  for (int i = 0; i < count; ++i) {
    const glm::vec4 color(static_cast<float>(i), random.real(0.0f, 1.0f), 0.0f, 1.0f);
    const glm::vec2 center(random.real(-1.0f, 1.0f), random.real(-1.0f, 1.0f));
    for (std::size_t k = 0; k < corners; ++k) {
      const float w = i % 50 == 0 && k == 0 ? -0.01f : 1.0f;
      p.positions.emplace_back(center.x + random.real(-0.1f, 0.1f), center.y + random.real(-0.1f, 0.1f), 0.0f, w);
      p.colors.push_back(color);
    }
  }
  return p;
}

struct DrawsPicture {
  Image<glm::vec4> image{kDrawsSize, kDrawsSize};
  PassStatistics statistics;
};

// Splits the primitives into draws whose sizes cycle through the given list.
DrawsPicture draw_in_parts(const Primitives& p, const std::vector<std::size_t>& sizes, int threads, const PassOptions& options = {}) {
  DrawsPicture drawn;
  Pass pass(kDrawsSize, kDrawsSize, rgba32f_target(drawn.image), {}, options);
  std::size_t first = 0;
  for (std::size_t i = 0; first < p.positions.size(); ++i) {
    const std::size_t n = std::min(p.corners * sizes[i % sizes.size()], p.positions.size() - first);
    pass.draw(FlatColorShader{},
              make_vertex_view(stream(std::span(p.positions).subspan(first, n)), stream(std::span(p.colors).subspan(first, n))),
              {.topology = p.topology});
    first += n;
  }
  drawn.statistics = pass.run(Workers(threads));
  return drawn;
}

void expect_same(const DrawsPicture& a, const DrawsPicture& b) {
  EXPECT_TRUE(std::ranges::equal(a.image.texels(), b.image.texels()));
  EXPECT_EQ(a.statistics, b.statistics);
}

// Compares a single draw (with the default and the smallest chunk size) with the same primitives split into several draws.
void expect_any_parts_are_the_same(const Primitives& p, const std::vector<std::vector<std::size_t>>& splits) {
  const DrawsPicture whole = draw_in_parts(p, {p.count()}, 1);
  EXPECT_EQ(whole.statistics.primitives_in, p.count());
  EXPECT_EQ(whole.statistics.vertices_shaded, p.positions.size());
  EXPECT_GT(whole.statistics.fragments_shaded, 0u);
  expect_same(draw_in_parts(p, {p.count()}, 1, {.tuning = {.chunk_triangles = 7}}), whole);
  for (const std::vector<std::size_t>& sizes : splits) {
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(testing::Message() << "draws of " << sizes.front() << " primitives first, " << threads << " threads");
      expect_same(draw_in_parts(p, sizes, threads), whole);
    }
  }
}

// 45,000 triangles fill several chunks, each with the 4369 triangles that always fit. Draws of more than 2048 vertices are split.
TEST(Draws, SplitTrianglesAreDrawnInOrder) {
  expect_any_parts_are_the_same(many(Topology::triangles, 3, 45000), {{1}, {1, 0, 5, 1000, 2, 3000, 0, 0, 700}, {683, 682}, {0, 20000}});
}

// 80,000 points in one draw each fill a chunk with the maximum number of segments.
TEST(Draws, SplitPointsAreDrawnInOrder) { expect_any_parts_are_the_same(many(Topology::points, 1, 80000), {{1}, {2049, 2048}}); }

// A shader with a non-trivial destructor and a large alignment.
struct alignas(64) Holder : ConstantShader {
  std::shared_ptr<const int> stored;
  explicit Holder(std::shared_ptr<const int> held_) : stored(std::move(held_)) {}
  Holder(const Holder& other) : ConstantShader(other), stored(other.stored) { EXPECT_EQ(reinterpret_cast<uintptr_t>(this) % 64, 0u); }
};

TEST(Draws, KeepTheirShadersUntilThePassHasRun) {
  static_assert(!std::is_move_assignable_v<Pass>);  // otherwise draws could outlive the memory of their shaders
  const auto stored = std::make_shared<const int>(1);
  const std::vector<glm::vec4> positions{{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
  Image<glm::vec4> image(8, 8);
  {
    Pass pass(8, 8, rgba32f_target(image), {});
    for (int i = 0; i < 5; ++i) pass.draw(Holder(stored), make_vertex_view(stream(positions)));
    EXPECT_EQ(stored.use_count(), 6);
    Pass moved(std::move(pass));
    moved.draw(Holder(stored), make_vertex_view(stream(positions)));
    moved.run(one_worker());
    EXPECT_EQ(stored.use_count(), 1);
    moved.draw(Holder(stored), make_vertex_view(stream(positions)));
    EXPECT_EQ(stored.use_count(), 2);  // destroyed without being run
  }
  EXPECT_EQ(stored.use_count(), 1);
}

}  // namespace
}  // namespace halfspace::raster_test
