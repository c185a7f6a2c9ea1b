// SPDX-License-Identifier: Apache-2.0
//
// Tests multisampling: sample positions, shading, masks and resolve.
#include "halfspace/raster/sample_location.h"
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

// Positions in 1/16 px from the lower left corner of the pixel (Vulkan 1.3, standard sample locations).
const std::vector<std::vector<Point>> kStandard{
    {{12, 12}, {4, 4}}, {{6, 2}, {14, 6}, {2, 10}, {10, 14}}, {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};

std::vector<glm::vec4> square(const Point& low, const Point& high) {
  std::vector<glm::vec4> p;
  for (const Point& c : {low, Point{high.x, low.y}, high, low, high, Point{low.x, high.y}}) p.push_back(clip_position(c, 16, 16));
  return p;
}

// A tiny square around one sample of a pixel covers 1/n of the pixel, and a square next to the sample covers nothing.
TEST(Multisample, SamplesAreAtTheStandardPositions) {
  for (std::size_t pattern = 0; pattern < kStandard.size(); ++pattern) {
    const auto n = static_cast<int>(kStandard[pattern].size());
    for (int s = 0; s < n; ++s) {
      const Point at = kStandard[pattern][static_cast<std::size_t>(s)];
      EXPECT_EQ(sample_location(n, s), glm::vec2(at.x, at.y) / 16.0f);
      const Point low{(5 * 16 + at.x) * 16, (7 * 16 + at.y) * 16};
      const std::vector<glm::vec4> p = square(low, {low.x + 1, low.y + 1});
      Image<glm::vec4> image(16, 16);
      Pass pass(16, 16, rgba32f_target(image), {}, {.samples = n});
      pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.sample_mask = 1u << s});
      EXPECT_EQ(pass.run(one_worker()).samples_passed, 1u);
      EXPECT_EQ(pixel(image, 5, 7).x, 1.0f / static_cast<float>(n)) << n << " samples, number " << s;
      const std::vector<glm::vec4> beside = square({low.x + 1, low.y + 1}, {low.x + 2, low.y + 2});
      Pass other(16, 16, rgba32f_target(image), {}, {.samples = n});
      other.draw(ConstantShader{}, make_vertex_view(stream(beside)));
      EXPECT_EQ(other.run(one_worker()).samples_passed, 0u);
    }
  }
}

TEST(Multisample, DeferredPixelsAreShadedOncePerPrimitive) {
  for (const int n : {2, 4, 8}) {
    Image<glm::vec4> image(16, 16);
    const std::vector<glm::vec4> p = square({0, 0}, {16 * 256, 16 * 256});  // two triangles
    Pass pass(16, 16, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = n});
    for (int layer = 0; layer < 3; ++layer)
      pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.depth = {.compare = CompareOp::always}});
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.samples_passed, static_cast<uint64_t>(3 * n * 256));
    // The 16 pixels on the diagonal show both triangles, except with 2 samples, which are on the diagonal.
    EXPECT_EQ(s.fragments_shaded, n == 2 ? 256u : 256u + 16u);
    Pass each(16, 16, rgba32f_target(image), {}, {.samples = n, .supersample = true});
    each.draw(ConstantShader{}, make_vertex_view(stream(p)));
    EXPECT_EQ(each.run(one_worker()).fragments_shaded, static_cast<uint64_t>(n * 256));
    for (int i = 0; i < 256; ++i) EXPECT_EQ(image.data()[i], glm::vec4(1.0f));
  }
}

// Outputs the window position as a color, to distinguish per-sample from per-pixel shading.
struct PlaceShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
  };
  template <class R>
  struct Varyings {
    NoPerspective<vec2<R>> ndc;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.ndc.value = vec2<R>(in.position.x, in.position.y);
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(px.x, px.y, in.ndc.value.x, in.ndc.value.y)};
  }
};

TEST(Multisample, PerSampleShadingUsesSamplePositions) {
  const std::vector<glm::vec4> p = square({0, 0}, {16 * 256, 16 * 256});
  for (std::size_t pattern = 0; pattern < kStandard.size(); ++pattern) {
    for (std::size_t s = 0; s < kStandard[pattern].size(); ++s) {
      for (const bool by_sample : {false, true}) {
        Image<glm::vec4> image(16, 16);
        Pass pass(16, 16, rgba32f_target(image), {}, {.samples = static_cast<int>(kStandard[pattern].size())});
        pass.draw(PlaceShader{}, make_vertex_view(stream(p)), {.sample_shading = by_sample, .sample_mask = 1u << s});
        pass.run(one_worker());
        const glm::vec4 c = pixel(image, 3, 9) * static_cast<float>(kStandard[pattern].size());
        const Point at = by_sample ? kStandard[pattern][s] : Point{8, 8};
        const float x = 3.0f + static_cast<float>(at.x) / 16.0f, y = 9.0f + static_cast<float>(at.y) / 16.0f;
        EXPECT_EQ(c.x, x);
        EXPECT_EQ(c.y, y);
        EXPECT_NEAR(c.z, x / 8.0f - 1.0f, 3e-7f);  // the interpolation error is below 3e-7 of the largest value
        EXPECT_NEAR(c.w, y / 8.0f - 1.0f, 3e-7f);
      }
    }
  }
}

// A blend state that replaces the color, so the result is the same as without blending.
constexpr BlendState kReplace{.source_color = BlendFactor::one,
                              .destination_color = BlendFactor::zero,
                              .source_alpha = BlendFactor::one,
                              .destination_alpha = BlendFactor::zero};
// The rasterizer shades draws that blend in order, from a queue that holds pixels of several triangles.
TEST(Multisample, BlendedTrianglesCoverTheSameSamples) {
  Random r(7);
  std::vector<glm::vec4> p;
  for (int i = 0; i < 300; ++i) {
    const Point at{r.integer(0, 64 * 256), r.integer(0, 64 * 256)};
    for (int k = 0; k < 3; ++k) p.push_back(clip_position({at.x + r.integer(-1500, 1500), at.y + r.integer(-1500, 1500)}, 64, 64));
  }
  const auto draw = [&](int samples, const ColorTarget& target, const DrawState& state) {
    Pass pass(64, 64, target, {}, {.samples = samples});
    pass.draw(PlaceShader{}, make_vertex_view(stream(p)), state);
    pass.run(one_worker());
  };
  // The formats have different functions that write their samples.
  const auto expect_same = [&](auto opaque, auto blended, const auto& target_of) {
    for (const int n : {2, 4, 8}) {
      draw(n, target_of(opaque), {});
      draw(n, target_of(blended), {.blend = kReplace});
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) ASSERT_EQ(pixel(blended, x, y), pixel(opaque, x, y)) << n << " samples: " << x << ' ' << y;
      }
    }
  };
  expect_same(Image<glm::vec4>(64, 64), Image<glm::vec4>(64, 64), [](auto& image) { return rgba32f_target(image); });
  expect_same(Image<U16Vec4>(64, 64), Image<U16Vec4>(64, 64), [](auto& image) { return rgba16f_target(image); });
  expect_same(Image<glm::u8vec4>(64, 64), Image<glm::u8vec4>(64, 64), [](auto& image) { return rgba8_target(image); });
}

// A pixel is shaded once, however many of its samples a triangle covers.
TEST(Multisample, QueuedPixelsAreShadedOnce) {
  for (const int n : {2, 4, 8}) {
    for (const int side : {10, 100}) {  // px
      for (const bool writes_depth : {false, true}) {
        const Point low{13 * 256 + 77, 9 * 256 + 140};
        const std::vector<glm::vec4> p{clip_position(low, 128, 128), clip_position({low.x + side * 256, low.y + 300}, 128, 128),
                                       clip_position({low.x + 200, low.y + side * 256}, 128, 128)};
        Image<glm::vec4> image(128, 128);
        Pass pass(128, 128, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = n});
        pass.draw(PlaceShader{}, make_vertex_view(stream(p)), {.depth = {.write = writes_depth}, .blend = kReplace});
        const uint64_t shaded = pass.run(one_worker()).fragments_shaded;
        uint64_t drawn = 0;
        for (std::size_t i = 0; i < 128 * 128; ++i) drawn += image.data()[i].x != 0.0f ? 1 : 0;  // the color contains the window position
        EXPECT_EQ(shaded, drawn) << n << " samples, " << side << " px";
      }
    }
  }
}

// A pass with one sample per pixel, whose primitives are moved by the distance of a sample from the pixel center, draws exactly this
// sample. Points and most triangles are larger than those that the rasterizer draws in groups. The first half of them is not blended.
TEST(Multisample, EverySampleOfLargePrimitivesIsDrawnLikeAPixelCenter) {
  constexpr int kSide = 128;
  struct Primitives {
    std::vector<Point> places;
    std::vector<float> depths;
    std::vector<glm::vec4> colors;
  };
  Random r(11);
  Primitives triangles, points;
  const auto add = [&](Primitives& to, const Point& at, const glm::vec4& color) {
    to.places.push_back(at);
    to.depths.push_back(static_cast<float>(r.real(-0.99, 0.99)));
    to.colors.push_back(color);
  };
  for (int i = 0; i < 60; ++i) {
    const glm::vec4 color(r.integer(0, 255), r.integer(0, 255), r.integer(0, 255), r.integer(0, 255));
    const int reach = i % 3 == 0 ? 300 * 256 : 60 * 256;  // 1/256 px
    for (int k = 0; k < 3; ++k) add(triangles, {r.integer(-reach, reach) + 64 * 256, r.integer(-reach, reach) + 64 * 256}, color);
    add(points, {r.integer(0, kSide * 256), r.integer(0, kSide * 256)}, color);
  }
  const auto draw = [&](Image<glm::vec4>& image, const Primitives& what, const DrawState& state, const Point& shift, int samples) {
    std::vector<glm::vec4> p;
    for (std::size_t i = 0; i < what.places.size(); ++i)
      p.push_back(clip_position({what.places[i].x + shift.x, what.places[i].y + shift.y}, kSide, kSide, what.depths[i]));
    Pass pass(kSide, kSide, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = samples});
    const std::size_t half = what.places.size() / 2;
    const auto part = [half](const std::vector<glm::vec4>& values, std::size_t begin) {
      return stream(std::span<const glm::vec4>(values).subspan(begin, half));
    };
    const auto draw_part = [&](std::size_t begin, const DrawState& part_state) {
      pass.draw(FlatColorShader{}, make_vertex_view(part(p, begin), part(what.colors, begin)), part_state);
    };
    draw_part(0, {.topology = state.topology, .point_size = state.point_size, .sample_mask = state.sample_mask});
    draw_part(half, state);
    return pass.run(one_worker()).samples_passed;
  };
  const auto expect_equal = [&](const Primitives& what, const DrawState& state, std::size_t pattern) {
    const auto n = static_cast<int>(kStandard[pattern].size());
    Image<glm::vec4> image(kSide, kSide), one(kSide, kSide);
    const uint64_t passed = draw(image, what, state, {0, 0}, n);
    std::vector<glm::vec4> sums(static_cast<std::size_t>(kSide * kSide), glm::vec4(0));
    uint64_t expected = 0;
    for (std::size_t s = 0; s < kStandard[pattern].size(); ++s) {
      const Point at = kStandard[pattern][s];
      if ((state.sample_mask >> s & 1) == 0) continue;
      DrawState alone = state;
      alone.sample_mask = ~0u;
      expected += draw(one, what, alone, {128 - 16 * at.x, 128 - 16 * at.y}, 1);
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) sums[static_cast<std::size_t>(y * kSide + x)] += pixel(one, x, y);
      }
    }
    EXPECT_EQ(passed, expected) << n << " samples";
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::vec4 mean = sums[static_cast<std::size_t>(y * kSide + x)] / static_cast<float>(n);  // exact: sums of few integers
        ASSERT_EQ(pixel(image, x, y), mean) << n << " samples: " << x << ' ' << y;
      }
    }
  };
  DrawState added{.blend = kAdd}, written{.blend = kAdd}, masked{.blend = kAdd}, replaced;
  added.depth.write = false;
  masked.sample_mask = 0xA6;
  replaced.depth.compare = CompareOp::always;
  for (const DrawState& state : {DrawState{}, added, written, masked, replaced}) {
    for (std::size_t pattern = 0; pattern < kStandard.size(); ++pattern) {
      expect_equal(triangles, state, pattern);
      DrawState of_points = state;
      of_points.topology = Topology::points;
      of_points.point_size = 21.5f;
      expect_equal(points, of_points, pattern);
    }
  }
}

// OpenGL 4.6, section 17.3.1: alpha 0 covers nothing, alpha 1 covers everything, and coverage never decreases with alpha.
TEST(Multisample, AlphaToCoverageIsMonotonic) {
  const std::vector<glm::vec4> p = square({0, 0}, {16 * 256, 16 * 256});
  for (const int n : {2, 4, 8}) {
    float before = 0.0f;
    for (int step = 0; step <= 32; ++step) {
      const float alpha = static_cast<float>(step) / 32.0f;
      Image<glm::vec4> image(16, 16);
      Pass pass(16, 16, rgba32f_target(image), {.format = DepthFormat::d32f}, {.samples = n});
      pass.draw(ConstantShader{glm::vec4(1.0f, 1.0f, 1.0f, alpha)}, make_vertex_view(stream(p)), {.alpha_to_coverage = true});
      pass.run(one_worker());
      const float covered = image.at(7, 7).x;
      EXPECT_GE(covered, before);
      EXPECT_NEAR(covered, alpha, 0.5f / static_cast<float>(n));  // rounded to the nearest number of samples
      if (step == 0 || step == 32) {
        EXPECT_EQ(covered, alpha);
      }
      before = covered;
    }
  }
}

// OpenGL 4.6, section 17.3.1: alpha to coverage does not apply to integer colors, which have no alpha.
TEST(Multisample, AlphaToCoverageSkipsIntegerFormats) {
  const std::vector<glm::vec4> p = square({0, 0}, {16 * 256, 16 * 256});
  Image<uint32_t> image(16, 16);
  Pass pass(16, 16, r32ui_target(image), {}, {.samples = 4});
  pass.draw(ConstantIntegers<uvec4>{glm::ivec4(5, 0, 0, 0)}, make_vertex_view(stream(p)), {.alpha_to_coverage = true});
  pass.run(one_worker());
  EXPECT_EQ(image.at(7, 7), 5u);
}

// The sum of the samples is infinite, but their mean is not.
TEST(Multisample, TheLargestFloatResolvesToItself) {
  constexpr float kMax = std::numeric_limits<float>::max();
  const std::vector<glm::vec4> p = square({0, 0}, {8 * 256, 16 * 256});
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {}, {.samples = 4});
  pass.draw(ConstantShader{glm::vec4(kMax)}, make_vertex_view(stream(p)));
  pass.run(one_worker());
  EXPECT_EQ(pixel(image, 4, 4), glm::vec4(kMax));
}

// Along a slightly tilted edge, all n + 1 coverage values must occur (VK-GL-CTS has the same requirement).
TEST(Multisample, EdgesShowAllCoverageValuesAndSharedEdgesAreSeamless) {
  for (const int n : {2, 4, 8}) {
    Image<glm::vec4> image(64, 64);
    std::vector<glm::vec4> p;
    const Point a{100, 0}, b{64 * 256, 0}, c{64 * 256, 64 * 256}, d{7 * 256, 64 * 256};
    for (const Point& corner : {a, b, c, a, c, d}) p.push_back(clip_position(corner, 64, 64));
    Pass pass(64, 64, rgba32f_target(image), {}, {.samples = n});
    pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.blend = kAdd});
    pass.run(one_worker());
    std::vector<bool> seen(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i < 64 * 64; ++i) {
      const float samples = image.data()[i].x * static_cast<float>(n);
      ASSERT_LE(samples, static_cast<float>(n));  // no sample on the shared edge is drawn twice
      seen[static_cast<std::size_t>(samples)] = true;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), n + 1);
    for (int x = 20; x < 64; ++x) EXPECT_EQ(pixel(image, x, x).x, 1.0f) << x;  // and omits none
  }
}

TEST(Multisample, ResolveAveragesInLinearLight) {
  Image<glm::u8vec4> image(16, 16);
  const std::vector<glm::vec4> p = square({0, 0}, {16 * 256, 16 * 256});
  Pass pass(16, 16, srgb8a8_target(image), {}, {.samples = 2});
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)), {.sample_mask = 2});
  pass.run(one_worker());
  EXPECT_EQ(image.at(4, 4), (glm::u8vec4{188, 188, 188, 128}));  // 0.5 encoded in sRGB; 127.5 rounded up
}

}  // namespace

}  // namespace halfspace
