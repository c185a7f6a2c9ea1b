// SPDX-License-Identifier: Apache-2.0
//
// Color attachments with one to three 32-bit channels, integers, and the maximum number of attachments.
#include <algorithm>
#include <bit>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int kEdge = 70;  // tiles at the right and upper border are partial

const std::vector<glm::vec4>& everywhere() {
  static const std::vector<glm::vec4> positions = full_screen();
  return positions;
}

// Writes the window position, scaled by n + 1, to attachment n.
struct PlaceShader : PositionShader {
  template <class R>
  FragmentMRT<R, kMaxColorTargets> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    FragmentMRT<R, kMaxColorTargets> out;
    for (std::size_t n = 0; n < out.color.size(); ++n) {
      const R scale(static_cast<float>(n) + 1.0f);
      out.color[n] = vec4<R>(px.x * scale, px.y * scale, (px.x + px.y) * scale, R(0.5f));
    }
    return out;
  }
};

// Writes an integer whose bits, read as a float, are a NaN.
struct IntegerShader : PositionShader {
  template <class R>
  TypedFragment<R, uvec4<R>> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {uvec4<R>(UintOf<R>(truncate_to_int(px.x)) | UintOf<R>(0xffff0000u))};
  }
};

glm::vec3 place_at(int x, int y, float scale) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  return {px * scale, py * scale, (px + py) * scale};
}

TEST(NarrowFormats, StoreTheFirstChannels) {
  Image<float> one(kEdge, kEdge);
  Image<glm::vec2> two(kEdge, kEdge);
  Image<glm::vec3> three(kEdge, kEdge);
  for (const bool flushes : {false, true}) {
    const std::array targets{r32f_target(one, -1.0f), rg32f_target(two), rgb32f_target(three)};
    Pass pass(kEdge, kEdge, targets, {.format = DepthFormat::d32f},
              {.tuning = {.bin_budget = flushes ? std::size_t{1} : std::size_t{1} << 28}});
    const std::vector<glm::vec4> positions{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    for (int i = 0; i < 100; ++i) pass.draw(PlaceShader{}, make_vertex_view(stream(positions)));
    pass.run(one_worker());
    for (int y = 0; y < kEdge; ++y) {
      for (int x = 0; x < kEdge; ++x) {
        const bool inside = x + y + 1 < kEdge;
        if (x + y + 1 == kEdge) continue;  // on the edge
        EXPECT_EQ(pixel(one, x, y), inside ? place_at(x, y, 1).x : -1.0f);
        EXPECT_EQ(pixel(two, x, y), inside ? glm::vec2(place_at(x, y, 2)) : glm::vec2(0.0f));
        EXPECT_EQ(pixel(three, x, y), inside ? place_at(x, y, 3) : glm::vec3(0.0f));
      }
    }
  }
}

TEST(NarrowFormats, LoadsAndBlends) {
  Image<float> one(kEdge, kEdge);
  Image<glm::vec2> two(kEdge, kEdge);
  Image<glm::vec3> three(kEdge, kEdge);
  const auto add_one = [&](auto& image, auto target_of) {
    ColorTarget target = target_of(image);
    target.load = LoadOp::load;
    Pass pass(kEdge, kEdge, target, {});
    pass.draw(ConstantShader{{1, 2, 3, 4}}, make_vertex_view(stream(everywhere())), {.blend = kAdd});
    pass.run(one_worker());
  };
  for (int i = 0; i < 3; ++i) {
    add_one(one, [](auto& image) { return r32f_target(image); });
    add_one(two, [](auto& image) { return rg32f_target(image); });
    add_one(three, [](auto& image) { return rgb32f_target(image); });
  }
  EXPECT_TRUE(std::ranges::all_of(one.texels(), [](float v) { return v == 3.0f; }));
  EXPECT_TRUE(std::ranges::all_of(two.texels(), [](const glm::vec2& v) { return v == glm::vec2(3, 6); }));
  EXPECT_TRUE(std::ranges::all_of(three.texels(), [](const glm::vec3& v) { return v == glm::vec3(3, 6, 9); }));
}

TEST(NarrowFormats, FloatsAreResolvedToTheMean) {
  const std::vector<glm::vec4> half{{-1, -1, 0, 1}, {1.0f / kEdge, -1, 0, 1}, {1.0f / kEdge, 3, 0, 1}, {-1, 3, 0, 1}};
  const std::vector<uint32_t> indices{0, 1, 2, 0, 2, 3};
  Image<float> mean(kEdge, kEdge);
  Pass pass(kEdge, kEdge, r32f_target(mean, 8.0f), {}, {.samples = 4});
  pass.draw(ConstantShader{glm::vec4(4.0f)}, make_vertex_view(stream(half)), indices);
  pass.run(one_worker());
  EXPECT_EQ(pixel(mean, 10, 10), 4.0f);
  EXPECT_EQ(pixel(mean, 60, 10), 8.0f);
  EXPECT_EQ(pixel(mean, kEdge / 2, 10), 6.0f);  // the edge is at its center
}

TEST(NarrowFormats, IntegersKeepTheirBits) {
  for (const int samples : {1, 4}) {
    Image<uint32_t> image(kEdge, kEdge);
    Pass pass(kEdge, kEdge, r32ui_target(image, 0xffffffffu), {}, {.samples = samples});
    const std::vector<glm::vec4> positions{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    pass.draw(IntegerShader{}, make_vertex_view(stream(positions)));
    pass.run(one_worker());
    EXPECT_EQ(pixel(image, 20, 10), 0xffff0014u);
    EXPECT_EQ(pixel(image, 60, 60), 0xffffffffu);
  }
  Image<uint32_t> untouched(kEdge, kEdge);
  Pass(kEdge, kEdge, r32ui_target(untouched, 0x7f800001u), {}).run(one_worker());  // without a tile
  EXPECT_TRUE(std::ranges::all_of(untouched.texels(), [](uint32_t v) { return v == 0x7f800001u; }));
}

TEST(NarrowFormatsDeathTest, IntegersAreNotBlended) {
  Image<uint32_t> image(kEdge, kEdge);
  Pass pass(kEdge, kEdge, r32ui_target(image), {});
  EXPECT_DEATH(pass.draw(ConstantShader{}, make_vertex_view(stream(everywhere())), {.blend = kAdd}), "target of integers is blended");
}

TEST(NarrowFormats, AllAttachmentsAreWritten) {
  for (const int samples : {1, 8}) {
    std::vector<Image<glm::vec4>> images(kMaxColorTargets, Image<glm::vec4>(kEdge, kEdge));
    std::vector<ColorTarget> targets;
    for (Image<glm::vec4>& image : images) targets.push_back(rgba32f_target(image));
    Pass pass(kEdge, kEdge, targets, {.format = DepthFormat::d32f}, {.samples = samples});
    pass.draw(PlaceShader{}, make_vertex_view(stream(everywhere())));
    pass.run(Workers(2));
    for (std::size_t n = 0; n < images.size(); ++n) {
      for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x)
          ASSERT_EQ(pixel(images[n], x, y), glm::vec4(place_at(x, y, static_cast<float>(n) + 1.0f), 0.5f)) << n;
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::raster_test
