// SPDX-License-Identifier: Apache-2.0
//
// A shader that is constant by its type fills tiles without their memory where it can: the pictures are those of the same shader
// that is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

// ConstantShader asks for the pixel; this one asks for nothing.
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

constexpr int kSize = 256;  // 16 tiles

struct Drawn {
  Image<glm::u8vec4> color{kSize, kSize};
  PassStatistics statistics;
};

template <class Shader>
Drawn drawn(const Shader& shader, std::span<const glm::vec4> positions, const DrawState& state) {
  Drawn out;
  Pass pass(kSize, kSize, rgba8_target(out.color), {});  // with a depth to find, no tile is filled
  pass.draw(shader, vertices(stream(positions)), state);
  out.statistics = pass.run(one_worker());
  return out;
}

TEST(ConstantShaders, FillTilesOnlyWhereTheyCoverThem) {
  Random random(11);
  const glm::vec4 color(0.2f, 0.6f, 1.0f, 1.0f);
  for (int i = 0; i < effort(400); ++i) {
    // Up to twice the picture's size, so that some tiles are inside, some outside, most neither; alone in their bins.
    std::vector<glm::vec4> positions;
    for (int k = 0; k < 3; ++k) {
      const Point p{random.integer(-kSize * 256, 2 * kSize * 256), random.integer(-kSize * 256, 2 * kSize * 256)};
      positions.push_back(clip_position(p, kSize, kSize, random.real(-0.9f, 0.9f)));
    }
    DrawState state;
    if (i % 4 == 1) state.scissor = Rect{random.integer(0, 100), random.integer(0, 100), random.integer(1, 200), random.integer(1, 200)};
    const Drawn paint = drawn(PaintShader{color}, positions, state), any = drawn(ConstantShader{color}, positions, state);
    ASSERT_TRUE(std::ranges::equal(paint.color.texels(), any.color.texels())) << i;
    ASSERT_EQ(paint.statistics.samples_passed, any.statistics.samples_passed) << i;
    ASSERT_EQ(paint.statistics.fragments_shaded, any.statistics.fragments_shaded) << i;
  }
}

// Tiles of one colour go into the image several in a row: each keeps its own, for any number of threads.
TEST(ConstantShaders, TilesInARowKeepTheirColors) {
  constexpr int kTile = 64, kWidth = 12 * kTile + 20, kHeight = 2 * kTile + 9;
  constexpr std::array<int, 13> kColumns{-1, -1, 0, 0, 0, 1, 1, -1, 0, 1, 2, 2, -1};  // the draw that covers a column of tiles, or none
  const glm::vec4 cleared(0.25f, 0.5f, 0.75f, 1.0f);
  const auto color_of = [&](int draw) { return draw < 0 ? cleared : glm::vec4(0.1f * static_cast<float>(draw + 1)); };
  const std::vector<glm::vec4> corners{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
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
        pass.draw(PaintShader{color_of(kColumns[i])}, vertices(stream(corners)), state);
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

}  // namespace
}  // namespace halfspace::raster_test
