// SPDX-License-Identifier: Apache-2.0
//
// Shaders whose type shows that their color is constant can fill tiles without using tile memory. The result must be the same as with an
// equivalent shader whose type does not show it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "halfspace/raster/visibility/coverage/area_coverage.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

// The fragment function of ConstantShader has a Pixel parameter. This one does not, so its type shows that the color is constant.
struct PaintShader {
  glm::vec4 color;
  template <class R>
  using Attributes = ConstantShader::Attributes<R>;
  template <class R>
  using Varyings = ConstantShader::Varyings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w))};
  }
};

constexpr int kPictureSize = 256;  // 16 tiles

struct ConstantPicture {
  Image<glm::u8vec4> color{kPictureSize, kPictureSize};
  PassStatistics statistics;
};

template <class Shader>
ConstantPicture drawn(const Shader& shader, std::span<const glm::vec4> positions, const DrawState& state) {
  ConstantPicture out;
  Pass pass(kPictureSize, kPictureSize, rgba8_target(out.color), {});  // tiles are filled directly only without depth
  pass.draw(shader, make_vertex_view(stream(positions)), state);
  out.statistics = pass.run(one_worker());
  return out;
}

TEST(ConstantShaders, FillOnlyTilesThatTheyCover) {
  Random random(11);
  const glm::vec4 color(0.2f, 0.6f, 1.0f, 1.0f);
  for (int i = 0; i < effort(400); ++i) {
    // The triangle is up to twice the size of the picture, so some tiles are inside it, some are outside, and most straddle an edge.
    std::vector<glm::vec4> positions;
    for (int k = 0; k < 3; ++k) {
      const Point p{random.integer(-kPictureSize * 256, 2 * kPictureSize * 256),
                    random.integer(-kPictureSize * 256, 2 * kPictureSize * 256)};
      positions.push_back(clip_position(p, kPictureSize, kPictureSize, random.real(-0.9f, 0.9f)));
    }
    // Every second picture has a second triangle that shares an edge with the first one. In a few cases, it is the same triangle.
    if (i % 2 == 1) {
      const auto edge = static_cast<std::size_t>(random.integer(0, 2));
      const glm::vec4 a = positions[edge], b = positions[(edge + 1) % 3], c = positions[(edge + 2) % 3];
      const float along = random.real(0.0f, 1.0f), beyond = random.real(0.2f, 2.0f);
      positions.insert(positions.end(), {b, a, i % 16 == 3 ? c : a + b - c + (b - a) * along + (a - c) * beyond});
    }
    DrawState state;
    if (i % 4 == 1) state.scissor = Rect{random.integer(0, 100), random.integer(0, 100), random.integer(1, 200), random.integer(1, 200)};
    const ConstantPicture paint = drawn(PaintShader{color}, positions, state), any = drawn(ConstantShader{color}, positions, state);
    ASSERT_TRUE(std::ranges::equal(paint.color.texels(), any.color.texels())) << i;
    ASSERT_EQ(paint.statistics.samples_passed, any.statistics.samples_passed) << i;
    ASSERT_EQ(paint.statistics.fragments_shaded, any.statistics.fragments_shaded) << i;
  }
}

TEST(CoveredArea, PairsCoverEveryPixelExactlyOnce) {
  Random random(5);
  const auto rotated = [](Triangle t) {
    if ((t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) < (t.y[1] - t.y[0]) * (t.x[2] - t.x[0])) {
      std::swap(t.x[1], t.x[2]);
      std::swap(t.y[1], t.y[2]);
    }
    return t;
  };
  int together = 0;
  for (int i = 0; i < effort(200000); ++i) {
    const auto at = [&] { return random.integer(-3000, 3000); };
    const auto triangle = [&](std::array<int32_t, 3> x, std::array<int32_t, 3> y) {
      Triangle made{};
      made.x = x;
      made.y = y;
      return rotated(made);
    };
    const Triangle t = triangle({at(), at(), at()}, {at(), at(), at()});
    const std::size_t k = static_cast<std::size_t>(random.integer(0, 2)), n = (k + 1) % 3;
    // A third of the pairs share an edge. In another third, one end of the edge is moved, and in the last third both ends.
    std::array<int32_t, 3> ux{t.x[n], t.x[k], at()}, uy{t.y[n], t.y[k], at()};
    std::array<int32_t, 3>& moved = i % 6 < 3 ? ux : uy;
    const int by = random.integer(-300, 300);
    if (i % 3 != 0) moved[i % 4 < 2 ? 0 : 1] += by;
    if (i % 3 == 1) moved[i % 4 < 2 ? 1 : 0] += by;
    const Triangle u = triangle(ux, uy);
    const int x = random.integer(-4, 2), y = random.integer(-4, 2);
    const PixelBounds area{x, y, x + random.integer(1, 3), y + random.integer(1, 3)};
    const auto count = [](const Triangle& of, int px, int py) {
      int inside = 0;
      for (std::size_t e = 0; e < 3; ++e) {
        const Edge edge = edge_of(of, e);
        inside += edge.at(px * kSubPixels + kSubPixels / 2, py * kSubPixels + kSubPixels / 2) >= fill_bias(edge) ? 1 : 0;
      }
      return inside == 3 ? 1 : 0;
    };
    bool first = true, each_once = true;
    for (int py = area.y0; py < area.y1; ++py) {
      for (int px = area.x0; px < area.x1; ++px) {
        first &= count(t, px, py) == 1;
        each_once &= count(t, px, py) + count(u, px, py) == 1;
      }
    }
    ASSERT_EQ(covers(t, area), first) << i;
    // A positive answer must be correct. Pairs that cover the area without sharing an edge need not be recognized.
    ASSERT_TRUE(!cover_together(t, u, area) || each_once) << i;
    together += cover_together(t, u, area) ? 1 : 0;
  }
  EXPECT_GT(together, effort(200000) / 2000);
}

// Tiles of a single color are written to the image in runs. Each tile must keep its own color for any thread count.
TEST(ConstantShaders, RunsOfTilesKeepTheirColors) {
  constexpr int kTile = 64, kWidth = 12 * kTile + 20, kHeight = 2 * kTile + 9;
  constexpr std::array<int, 13> kColumns{-1, -1, 0, 0, 0, 1, 1, -1, 0, 1, 2, 2, -1};  // the draw that covers each column of tiles; −1: none
  const glm::vec4 cleared(0.25f, 0.5f, 0.75f, 1.0f);
  const auto color_of = [&](int draw) { return draw < 0 ? cleared : glm::vec4(0.1f * static_cast<float>(draw + 1)); };
  const std::vector<glm::vec4> corners = full_screen();
  for (const int threads : {1, 2, 7}) {
    for (const LoadOp load : {LoadOp::clear, LoadOp::load}) {
      Image<glm::vec4> image(kWidth, kHeight);
      ColorTarget target = rgba32f_target(image);
      target.load = load;
      target.clear_value = cleared;
      Pass pass(kWidth, kHeight, target, {});
      for (std::size_t i = 0; i < kColumns.size(); ++i) {
        if (kColumns[i] < 0) continue;
        const int x = static_cast<int>(i) * kTile;
        DrawState state;
        state.viewport = Rect{x, 0, std::min(kTile, kWidth - x), kHeight};
        pass.draw(PaintShader{color_of(kColumns[i])}, make_vertex_view(stream(corners)), state);
      }
      pass.run(Workers(threads));
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const int draw = kColumns[static_cast<std::size_t>(x / kTile)];
          const glm::vec4 want = draw < 0 && load == LoadOp::load ? glm::vec4(0.0f) : color_of(draw);
          ASSERT_EQ(image.at(x, y), want) << x << ' ' << y << ", threads " << threads;
        }
      }
    }
  }
}

// Rows of tiles with the same color are written to the image in one operation, which uses a string instruction if the area is large. The
// rows above and below must not change. Some widths are multiples of a cache line and some are not; for some heights, the last row of tiles
// is partial.
template <class Texel>
class RowsOfOneColor : public testing::Test {};
using Texels = testing::Types<glm::u8vec4, U16Vec4, glm::vec4>;
TYPED_TEST_SUITE(RowsOfOneColor, Texels);

ColorTarget target_of(Image<glm::u8vec4>& image) { return rgba8_target(image); }
ColorTarget target_of(Image<U16Vec4>& image) { return rgba16f_target(image); }
ColorTarget target_of(Image<glm::vec4>& image) { return rgba32f_target(image); }

TYPED_TEST(RowsOfOneColor, DoNotOverwriteAdjacentRows) {
  constexpr int kTile = 64;
  constexpr std::array<int, 17> kRows{-1, 0, 0, 1, -1, 2, -1, -1, 0,
                                      1,  2, 0, 1, -1, 2, 0,  -1};  // from the bottom: the draw that covers each row of tiles; −1: none
  const glm::vec4 cleared(0.25f, 0.5f, 0.75f, 1.0f);
  const std::vector<glm::vec4> corners = full_screen();
  for (const auto& [width, height] : {std::pair(1024, 16 * kTile + 40), std::pair(1027, 17 * kTile), std::pair(130, 17 * kTile)}) {
    for (const LoadOp load : {LoadOp::clear, LoadOp::load}) {
      Image<TypeParam> image(width, height), one(1, 4);  // one: the colors as represented in the format
      for (int draw = -1; draw < 3; ++draw) {
        Image<TypeParam> pixel(1, 1);
        ColorTarget target = target_of(pixel);
        target.clear_value = draw < 0 ? cleared : glm::vec4(0.2f * static_cast<float>(draw + 1));
        Pass(1, 1, target, {}).run(one_worker());
        one.at(0, draw + 1) = draw < 0 && load == LoadOp::load ? TypeParam{} : pixel.at(0, 0);
      }
      ColorTarget target = target_of(image);
      target.load = load;
      target.clear_value = cleared;
      Pass pass(width, height, target, {});
      for (std::size_t i = 0; i < kRows.size(); ++i) {
        if (kRows[i] < 0) continue;
        const int y = static_cast<int>(i) * kTile;
        DrawState state;
        state.viewport = Rect{0, y, width, std::min(kTile, height - y)};
        pass.draw(PaintShader{glm::vec4(0.2f * static_cast<float>(kRows[i] + 1))}, make_vertex_view(stream(corners)), state);
      }
      const PassStatistics statistics = pass.run(Workers(3));
      uint64_t drawn = 0;
      for (int y = 0; y < height; ++y) {
        const int draw = kRows[static_cast<std::size_t>((height - 1 - y) / kTile)];
        const TypeParam want = one.at(0, draw + 1);
        ASSERT_EQ(std::count(image.row(y).begin(), image.row(y).end(), want), width) << "row " << y << " of " << width << 'x' << height;
        if (draw >= 0) drawn += static_cast<uint64_t>(width);
      }
      EXPECT_EQ(statistics.samples_passed, drawn);
      EXPECT_EQ(statistics.fragments_shaded, drawn);
    }
  }
}

TEST(ConstantShaders, ClearedDepthIsStored) {
  constexpr int kWidth = 1152, kHeight = 960;  // 4.4 MB
  Image<float> depth(kWidth, kHeight);
  DepthTarget target = d32f_target(depth);
  target.store = StoreOp::store;
  target.clear_value = 0.375f;
  Pass(kWidth, kHeight, {}, target).run(Workers(2));
  EXPECT_EQ(std::count(depth.data(), depth.data() + kWidth * kHeight, 0.375f), kWidth * kHeight);
}

}  // namespace
}  // namespace halfspace::raster_test
