// SPDX-License-Identifier: Apache-2.0
//
// Small triangles are rasterized in groups of W. All colors, depths and the number of passing samples must be the same as if each triangle
// were drawn in a separate pass. The test mixes draws with and without a stencil test, uses equal depths, and varies the extents from one
// pixel to beyond the limit for small triangles.
#include <algorithm>
#include <tuple>

#include "halfspace/raster/tile/tile.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int kSmallSize = 128;

struct Triangles {
  std::vector<glm::vec4> positions, colors;
  DrawState state;
};

StencilFace random_face(Random& r) {
  const auto operation = [&r] { return static_cast<StencilOp>(r.integer(0, static_cast<int>(StencilOp::decrement_wrap))); };
  return {.compare = static_cast<CompareOp>(r.integer(0, 7)),
          .fail = operation(),
          .depth_fail = operation(),
          .pass = operation(),
          .reference = static_cast<uint8_t>(r.integer(0, 3)),
          .read_mask = static_cast<uint8_t>(r.coin() ? 0xff : 0x03),
          .write_mask = static_cast<uint8_t>(r.coin() ? 0xff : 0x03)};
}

// Returns up to three times W triangles for one draw (W is at most 16). The first vertex is in or near the picture, and depths have one of
// five values.
Triangles random_triangles(Random& r) {
  Triangles t;
  const int count = r.integer(1, 48), largest = r.coin() ? 3 : r.coin() ? 16 : 70;
  for (int i = 0; i < count; ++i) {
    const Point at{r.integer(-8 * kSubPixels, (kSmallSize + 8) * kSubPixels), r.integer(-8 * kSubPixels, (kSmallSize + 8) * kSubPixels)};
    const glm::vec4 color(r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), 1.0f);
    for (int corner = 0; corner < 3; ++corner) {
      const Point p{at.x + r.integer(0, largest * kSubPixels), at.y + r.integer(0, largest * kSubPixels)};
      t.positions.push_back(clip_position(p, kSmallSize, kSmallSize, 0.25f * static_cast<float>(r.integer(-2, 2))));
      t.colors.push_back(color);
    }
  }
  t.state.depth.test = r.integer(0, 5) != 0;
  t.state.depth.write = r.integer(0, 4) != 0;
  t.state.depth.compare = static_cast<CompareOp>(r.integer(0, 7));
  if (r.coin()) t.state.stencil = StencilState{random_face(r), random_face(r)};
  if (r.coin()) t.state.scissor = Rect{r.integer(0, 40), r.integer(0, 40), r.integer(1, 90), r.integer(1, 90)};
  return t;
}

struct SmallPicture {
  Image<glm::vec4> color{kSmallSize, kSmallSize};
  Image<DepthStencil> depth{kSmallSize, kSmallSize};
  PassStatistics statistics;
};

// Draws on top of the existing contents.
void draw(std::span<const Triangles> draws, SmallPicture& out) {
  ColorTarget color = rgba32f_target(out.color);
  DepthTarget depth = d32fs8_target(out.depth);
  color.load = depth.load = LoadOp::load;
  Pass pass(kSmallSize, kSmallSize, color, depth);
  for (const Triangles& t : draws) pass.draw(FlatColorShader{}, make_vertex_view(stream(t.positions), stream(t.colors)), t.state);
  out.statistics += pass.run(one_worker());
}

// Returns only the k-th triangle.
Triangles only(const Triangles& t, std::size_t k) {
  const auto three = [k](const std::vector<glm::vec4>& all) {
    const std::span part = std::span(all).subspan(3 * k, 3);
    return std::vector<glm::vec4>(part.begin(), part.end());
  };
  return {three(t.positions), three(t.colors), t.state};
}

TEST(SmallTriangles, BatchesMatchIndividualTriangles) {
  Random random(22);
  uint64_t passed = 0;
  for (int i = 0; i < effort(400); ++i) {
    std::vector<Triangles> draws(static_cast<std::size_t>(random.integer(1, 3)));
    for (Triangles& t : draws) t = random_triangles(random);
    SmallPicture together, single;
    for (SmallPicture* d : {&together, &single}) std::fill_n(d->depth.data(), kSmallSize * kSmallSize, DepthStencil{0.5f, 1});
    draw(draws, together);
    for (const Triangles& t : draws) {
      for (std::size_t k = 0; k < t.positions.size() / 3; ++k) draw(std::array{only(t, k)}, single);
    }
    ASSERT_TRUE(std::equal(together.color.data(), together.color.data() + kSmallSize * kSmallSize, single.color.data())) << i;
    ASSERT_TRUE(std::equal(together.depth.data(), together.depth.data() + kSmallSize * kSmallSize, single.depth.data())) << i;
    ASSERT_EQ(together.statistics.samples_passed, single.statistics.samples_passed) << i;
    passed += together.statistics.samples_passed;
  }
  EXPECT_GT(passed, static_cast<uint64_t>(effort(400)) * 100) << "too few samples passed";
}

// A small triangle with a stencil test writes a larger depth than any in its block. A large triangle in front of it must not be rejected by
// the bounds of the block.
TEST(SmallTriangles, WithStencilUpdateTheDepthBoundsOfTheirBlock) {
  constexpr int kFirst = 8 * kSubPixels;
  const auto corner = [](int x, int y) {
    return clip_position({kFirst + x * kSubPixels, kFirst + y * kSubPixels}, kSmallSize, kSmallSize, 0.8f);
  };
  const Triangles small{.positions = {corner(0, 0), corner(3, 0), corner(0, 3)},
                        .colors = std::vector<glm::vec4>(3, glm::vec4(1)),
                        .state = {.depth = {.compare = CompareOp::always}, .stencil = StencilState{}}};
  const Triangles large{.positions = full_screen(0.4f), .colors = std::vector<glm::vec4>(3, glm::vec4(1)), .state = {}};
  SmallPicture out;
  std::fill_n(out.depth.data(), kSmallSize * kSmallSize, DepthStencil{0.5f, 0});
  draw(std::array{small, large}, out);
  const auto drawn =
      std::count_if(out.depth.data(), out.depth.data() + kSmallSize * kSmallSize, [](const DepthStencil& d) { return d.depth != 0.5f; });
  EXPECT_EQ(drawn, 3);  // the pixels of the small triangle, at depth 0.9: only there is the large one (0.7) in front
  for (const DepthStencil& d : std::span(out.depth.data(), kSmallSize * kSmallSize)) EXPECT_NE(d.depth, 0.9f);
  EXPECT_EQ(out.statistics.samples_passed, 6u);
}

// Hidden triangles whose bounding box has fewer than 24 pixels in a tile are tested all the same. In the layers below, they have 0.1% (one
// sample) to 2.4% (eight samples, tiles of 16 pixels) of the samples, so less than a twentieth.
constexpr uint64_t kRestOfHidden = 20;

// Draws a layer of small triangles that covers the whole target, and behind it the same layer.
PassStatistics draw_hidden_layer(int samples, const DrawState& state) {
  constexpr int kCell = 12;  // px; not a divisor of the block and tile sizes, so that triangles cross their borders
  const auto layer = [](float z) {
    std::vector<glm::vec4> positions;
    for (int y = 0; y < kSmallSize; y += kCell) {
      for (int x = 0; x < kSmallSize; x += kCell) {
        const auto corner = [&](int dx, int dy) {
          return clip_position({(x + dx) * kSubPixels, (y + dy) * kSubPixels}, kSmallSize, kSmallSize, z);
        };
        const glm::vec4 a = corner(0, 0), b = corner(kCell, 0), c = corner(kCell, kCell), d = corner(0, kCell);
        positions.insert(positions.end(), {a, b, c, a, c, d});
      }
    }
    return positions;
  };
  Image<glm::vec4> image(kSmallSize, kSmallSize);
  Pass pass(kSmallSize, kSmallSize, rgba32f_target(image), {.format = DepthFormat::d32fs8}, {.samples = samples});
  const std::vector<glm::vec4> near = layer(-0.5f), far = layer(0.5f), colors(near.size(), glm::vec4(1));
  for (const auto* positions : {&near, &far}) pass.draw(FlatColorShader{}, make_vertex_view(stream(*positions), stream(colors)), state);
  return pass.run(one_worker());
}

TEST(SmallTriangles, HiddenOnesAreRejectedBeforeTheirSamplesAreTested) {
  for (const int samples : {1, 2, 4, 8}) {
    const PassStatistics s = draw_hidden_layer(samples, {});
    const auto covered = static_cast<uint64_t>(samples) * kSmallSize * kSmallSize;
    EXPECT_EQ(s.samples_passed, covered);
    EXPECT_LT(s.samples_tested, covered + covered / kRestOfHidden) << samples << " samples";
  }
}

// Draws the layers with the given stencil operations for failed tests, as opaque and as blended triangles.
void expect_hidden_layer_tested(int samples, StencilOp fail, StencilOp depth_fail) {
  const uint64_t covered = uint64_t{kSmallSize} * kSmallSize * static_cast<uint64_t>(samples);
  const StencilFace face{.fail = fail, .depth_fail = depth_fail, .pass = StencilOp::increment_clamp};
  for (const std::optional<BlendState>& blend : {std::optional<BlendState>(), std::optional(kAlphaBlend)}) {
    const PassStatistics s = draw_hidden_layer(samples, {.stencil = StencilState{face, face}, .blend = blend});
    EXPECT_EQ(s.samples_passed, covered);
    if (fail == StencilOp::keep && depth_fail == StencilOp::keep) {
      EXPECT_LT(s.samples_tested, covered + covered / kRestOfHidden);
    } else {
      EXPECT_EQ(s.samples_tested, 2 * covered);
    }
  }
}

TEST(SmallTriangles, HiddenOnesAreTestedIfTheyChangeTheStencil) {
  for (const int samples : {1, 4}) {
    expect_hidden_layer_tested(samples, StencilOp::keep, StencilOp::keep);
    expect_hidden_layer_tested(samples, StencilOp::invert, StencilOp::keep);
    expect_hidden_layer_tested(samples, StencilOp::keep, StencilOp::increment_clamp);
  }
}

TEST(SmallTriangles, PixelIndicesMatchPacketPositions) {
  for (int p = 0; p < kPackets; ++p) {
    const Int together = pixel_at(lane_x() + packet_x(p), lane_y() + packet_y(p));
    for (int k = 0; k < kLanes; ++k) {
      ASSERT_EQ(lane(together, k), p * kLanes + k);
      ASSERT_EQ(pixel_at(packet_x(p) + block_x(k), packet_y(p) + block_y(k)), p * kLanes + k);
    }
  }
}

}  // namespace
}  // namespace halfspace::raster_test
