// SPDX-License-Identifier: Apache-2.0
//
// A pass shares its work among threads: large draws are split, small ones put together. None of it may show.
#include <algorithm>
#include <memory>

#include "raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int kSize = 96;

struct Triangles {
  std::vector<glm::vec4> positions, colors;  // three a triangle
};

// Of some pixels each, one behind the other: their order shows in every pixel. Enough that chunks grow.
Triangles many_triangles() {
  Random random(31);
  Triangles t;
  for (int i = 0; i < 40000; ++i) {
    const glm::vec4 color(static_cast<float>(i), random.real(0.0f, 1.0f), 0.0f, 1.0f);
    const glm::vec2 center(random.real(-1.0f, 1.0f), random.real(-1.0f, 1.0f));
    for (int k = 0; k < 3; ++k) {
      t.positions.emplace_back(center.x + random.real(-0.1f, 0.1f), center.y + random.real(-0.1f, 0.1f), 0.0f, 1.0f);
      t.colors.push_back(color);
    }
  }
  return t;
}

struct Drawn {
  Image<glm::vec4> image{kSize, kSize};
  PassStatistics statistics;
};

// The triangles in draws of these many, over and over.
Drawn draw_in_parts(const Triangles& t, const std::vector<std::size_t>& sizes, int threads) {
  Drawn drawn;
  Pass pass(kSize, kSize, rgba32f_target(drawn.image), {});
  std::size_t first = 0;
  for (std::size_t i = 0; first < t.positions.size(); ++i) {
    const std::size_t n = std::min(3 * sizes[i % sizes.size()], t.positions.size() - first);
    pass.draw(FlatColorShader{}, vertices(stream(std::span(t.positions).subspan(first, n)), stream(std::span(t.colors).subspan(first, n))));
    first += n;
  }
  drawn.statistics = pass.run(Workers(threads));
  return drawn;
}

TEST(Draws, OfAnySizeAreDrawnInTheirOrder) {
  const Triangles t = many_triangles();
  const Drawn whole = draw_in_parts(t, {t.positions.size()}, 1);
  EXPECT_EQ(whole.statistics.vertices_shaded, t.positions.size());
  const std::vector<std::vector<std::size_t>> splits{{1}, {1, 0, 5, 1000, 2, 3000, 0, 0, 700}, {683, 682}, {0, 20000}};
  for (const std::vector<std::size_t>& sizes : splits) {
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(testing::Message() << "draws from " << sizes.front() << " triangles on, " << threads << " threads");
      const Drawn parts = draw_in_parts(t, sizes, threads);
      EXPECT_TRUE(std::ranges::equal(parts.image.texels(), whole.image.texels()));
      EXPECT_EQ(parts.statistics.vertices_in, whole.statistics.vertices_in);
      EXPECT_EQ(parts.statistics.vertices_shaded, whole.statistics.vertices_shaded);
      EXPECT_EQ(parts.statistics.fragments_shaded, whole.statistics.fragments_shaded);
    }
  }
}

TEST(Draws, KeepTheirShaderUntilThePassHasRun) {
  struct Holder : ConstantShader {
    std::shared_ptr<const int> held;
  };
  const auto held = std::make_shared<const int>(1);
  const std::vector<glm::vec4> positions{{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
  Image<glm::vec4> image(8, 8);
  Pass pass(8, 8, rgba32f_target(image), {});
  for (int i = 0; i < 5; ++i) pass.draw(Holder{{}, held}, vertices(stream(positions)));
  EXPECT_EQ(held.use_count(), 6);
  pass.run(one_worker());
  EXPECT_EQ(held.use_count(), 1);
  {
    Pass never_run(8, 8, rgba32f_target(image), {});
    never_run.draw(Holder{{}, held}, vertices(stream(positions)));
    EXPECT_EQ(held.use_count(), 2);
  }
  EXPECT_EQ(held.use_count(), 1);
}

}  // namespace
}  // namespace halfspace::raster_test
