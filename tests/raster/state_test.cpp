// SPDX-License-Identifier: Apache-2.0
//
// Tests draw and pass state with small cases: culling, viewport and scissor, provoking vertex, load and store, post step, statistics,
// vertex views and indices, and the checks that detect misuse.
#include <algorithm>
#include <cmath>
#include <functional>

#include "halfspace/raster/sample_location.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

// ---- shaders ---------------------------------------------------------------------------------------------------

// Outputs which face is visible: (1, 0) for front, (0, 1) for back.
struct FacingShader : PositionShader {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(select(px.front_facing, R(1), R(0)), select(px.front_facing, R(0), R(1)), R(0), R(1))};
  }
};

// Outputs the values of the three vertices in submission order, using the primitive stage.
struct OrderShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    R value;
  };
  template <class R>
  struct Varyings {
    R value;
  };
  template <class R>
  struct Primitive {
    vec3<R> values;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.value = in.value;
    return in.position;
  }
  template <class R>
  Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2) const {
    return {vec3<R>(v0.value, v1.value, v2.value)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Primitive<R>& face, const Pixel<R>&) const {
    return {vec4<R>(face.values, R(1))};
  }
};

// Keeps only the left half of the window.
template <bool has_visibility>
struct HalfShader;
template <>
struct HalfShader<false> : PositionShader {
  float edge = 32;
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(1)), px.x < R(edge)};
  }
};
template <>
struct HalfShader<true> : HalfShader<false> {
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    return {px.x < R(edge), px.z()};
  }
};

// Writes its own depth, x/64.
template <bool has_visibility>
struct DepthShader;
template <>
struct DepthShader<false> : PositionShader {
  glm::vec4 color{1.0f};
  float scale = 1.0f / 64, bias = 0;
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w)), MaskOf<R>(true), px.x * R(scale) + R(bias)};
  }
};
template <>
struct DepthShader<true> : DepthShader<false> {
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    return {MaskOf<R>(true), px.x * R(scale) + R(bias)};
  }
};

const std::vector<glm::vec4> kFullScreen = full_screen();

template <class S>
PassStatistics draw(Image<glm::vec4>& image, const S& shader, const std::vector<glm::vec4>& positions, const DrawState& state = {},
                    const PassOptions& options = {}) {
  Pass pass(image.width(), image.height(), rgba32f_target(image), {}, options);
  pass.draw(shader, make_vertex_view(stream(positions)), state);
  return pass.run(one_worker());
}

int64_t drawn_pixels(const Image<glm::vec4>& image) {
  return std::count_if(image.texels().begin(), image.texels().end(), [](const glm::vec4& p) { return p != glm::vec4(0.0f); });
}

bool is_everywhere(const Image<glm::vec4>& image, const glm::vec4& want) {
  return std::all_of(image.texels().begin(), image.texels().end(), [&](const glm::vec4& p) { return p == want; });
}

// ---- culling ---------------------------------------------------------------------------------------------------

TEST(Culling, ModesAndWindingsSelectTheCulledFaces) {
  for (const Winding front : {Winding::counter_clockwise, Winding::clockwise}) {
    for (const bool counter_clockwise : {true, false}) {  // in the window, y up
      for (const CullMode mode : {CullMode::none, CullMode::front, CullMode::back, CullMode::front_and_back}) {
        for (const bool clipped : {false, true}) {
          std::vector<glm::vec4> p{{-1, -1, clipped ? -2.0f : 0.0f, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
          if (!counter_clockwise) std::swap(p[1], p[2]);
          const bool is_front = counter_clockwise == (front == Winding::counter_clockwise);
          const bool is_culled =
              mode == CullMode::front_and_back || (mode == CullMode::front && is_front) || (mode == CullMode::back && !is_front);
          DrawState state;
          state.front = front;
          state.cull = mode;
          Image<glm::vec4> image(32, 32);
          const PassStatistics s = draw(image, FacingShader{}, p, state);
          EXPECT_EQ(s.culled_face, is_culled ? 1u : 0u);
          EXPECT_EQ(s.clipped, clipped ? 1u : 0u);
          const glm::vec4 want = is_culled ? glm::vec4(0) : is_front ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1);
          EXPECT_EQ(pixel(image, 17, 14), want) << static_cast<int>(mode) << counter_clockwise << is_front;
        }
      }
    }
  }
}

// ---- viewport and scissor --------------------------------------------------------------------------------------

void expect_drawn_rect(const Image<glm::vec4>& image, int x0, int y0, int x1, int y1) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const bool want = x >= x0 && x < x1 && y >= y0 && y < y1;
      ASSERT_EQ(pixel(image, x, y) != glm::vec4(0), want) << x << ", " << y;
    }
  }
}

TEST(Viewport, DefaultsToTheWholeTarget) {
  Image<glm::vec4> image(70, 33);
  draw(image, ConstantShader{}, kFullScreen);
  expect_drawn_rect(image, 0, 0, 70, 33);
}

TEST(Viewport, OriginIsAtTheLowerLeftAndTheTopRowIsFirst) {
  // The lower left quarter: x and y from −1 to 0.
  Image<glm::vec4> image(8, 8);
  draw(image, ConstantShader{}, {{-1, -1, 0, 1}, {0, -1, 0, 1}, {-1, 0, 0, 1}, {0, -1, 0, 1}, {0, 0, 0, 1}, {-1, 0, 0, 1}});
  EXPECT_EQ(image.at(0, 7),
            glm::vec4(1));  // the last row in memory is at the bottom
  EXPECT_EQ(image.at(3, 4), glm::vec4(1));
  EXPECT_EQ(image.at(0, 0), glm::vec4(0));
  EXPECT_EQ(image.at(4, 7), glm::vec4(0));
}

TEST(Viewport, ConfinesDrawingToItsRectangle) {
  for (const Rect& v :
       {Rect{10, 20, 30, 7}, {0, 0, 1, 1}, {69, 39, 1, 1}, {-20, -5, 50, 30}, {60, 30, 50, 50}, {-100, -100, 1000, 1000}, {64, 0, 6, 40}}) {
    for (const int tile_size : {8, 64}) {
      Image<glm::vec4> image(70, 40);
      DrawState state;
      state.viewport = v;
      // The triangle extends far beyond the viewport, which confines drawing like a scissor rectangle.
      draw(image, ConstantShader{}, {{-5, -5, 0, 1}, {15, -5, 0, 1}, {-5, 15, 0, 1}}, state, {.tuning = {.tile_size = tile_size}});
      expect_drawn_rect(image, std::max(0, v.x), std::max(0, v.y), std::min(70, v.x + v.width), std::min(40, v.y + v.height));
    }
  }
}

TEST(Viewport, DrawsNothingIfOutsideOfTheTarget) {
  Image<glm::vec4> image(70, 40);
  DrawState state;
  state.viewport = Rect{70, 0, 10, 10};
  const PassStatistics s = draw(image, ConstantShader{}, kFullScreen, state);
  EXPECT_EQ(drawn_pixels(image), 0);
  EXPECT_EQ(s.culled_no_sample, 1u);
}

TEST(Viewport, TransformsPositions) {
  // The viewport starts at (16, 8) with a size of 32 × 16: x from −1 to 0 maps to 16 to 32, and y from 0 to 1 maps to 16 to 24.
  Image<glm::vec4> image(64, 32);
  DrawState state;
  state.viewport = Rect{16, 8, 32, 16};
  draw(image, ConstantShader{}, {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}, {0, 0, 0, 1}, {0, 1, 0, 1}, {-1, 1, 0, 1}}, state);
  expect_drawn_rect(image, 16, 16, 32, 24);
}

// A sample belongs to the viewport if it is in it: with one sample per pixel, the pixel's center.
TEST(Viewport, MayHaveFractionsOfAPixel) {
  for (const float x : {9.5f, 9.51f, 10.25f, 10.5f, 10.504f}) {
    for (const int samples : {1, 2, 4, 8}) {
      for (const float height : {7.75f, -7.75f}) {
        Image<glm::vec4> image(70, 40);
        const float y = height > 0 ? 20.375f : 28.125f;
        const DrawState state{.viewport = ViewportRect{x, y, 30.125f, height}};
        draw(image, ConstantShader{}, {{-5, -5, 0, 1}, {15, -5, 0, 1}, {-5, 15, 0, 1}}, state, {.samples = samples});
        const double left = std::round(static_cast<double>(x) * 256) / 256;
        for (int row = 0; row < 40; ++row) {
          for (int column = 0; column < 70; ++column) {
            float covered = 0;
            for (int s = 0; s < samples; ++s) {
              const glm::dvec2 p = glm::dvec2(column, row) + glm::dvec2(sample_location(samples, s));
              if (p.x >= left && p.x < left + 30.125 && p.y >= 20.375 && p.y < 28.125) covered += 1.0f / static_cast<float>(samples);
            }
            ASSERT_EQ(image.at(column, 39 - row).x, covered) << column << ' ' << row << ' ' << samples << " samples, x " << x;
          }
        }
      }
    }
  }
}

// The upper left origin and a negative height both turn the picture upside down. Only the negative height turns front into back faces.
TEST(Viewport, CanBeUpsideDown) {
  const std::vector<glm::vec4> triangle{{-0.9f, -0.7f, 0.2f, 1}, {0.8f, -0.3f, 0.4f, 1}, {-0.1f, 0.9f, 0.6f, 1}};
  const auto picture = [&](const DrawState& state) {
    Image<glm::vec4> image(64, 32);
    draw(image, FacingShader{}, triangle, state);
    return image;
  };
  const Image<glm::vec4> upright = picture({}), upper_left = picture({.clip_origin = ClipOrigin::upper_left}),
                         negative = picture({.viewport = ViewportRect{0, 32, 64, -32}}),
                         clockwise = picture({.viewport = ViewportRect{0, 32, 64, -32}, .front = Winding::clockwise}),
                         both = picture({.viewport = ViewportRect{0, 32, 64, -32}, .clip_origin = ClipOrigin::upper_left});
  ASSERT_GT(drawn_pixels(upright), 400);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const glm::vec4 front = upright.at(x, 31 - y);
      EXPECT_EQ(upper_left.at(x, y), front);
      EXPECT_EQ(clockwise.at(x, y), front);
      EXPECT_EQ(negative.at(x, y), front == glm::vec4(0) ? front : glm::vec4(0, 1, 0, 1));
      EXPECT_EQ(both.at(x, y), negative.at(x, 31 - y));
    }
  }
}

TEST(Scissor, ClipsToPixels) {
  for (const Rect& r :
       {Rect{3, 4, 5, 6}, {0, 0, 70, 40}, {-10, -10, 20, 20}, {65, 35, 100, 100}, {5, 5, 0, 10}, {5, 5, 10, 0}, {-50, 0, 50, 40}}) {
    for (const bool blended : {false, true}) {
      Image<glm::vec4> image(70, 40);
      DrawState state;
      state.scissor = r;
      if (blended) state.blend = kAdd;
      draw(image, ConstantShader{}, kFullScreen, state);
      const int x1 = std::min(70, r.x + r.width), y1 = std::min(40, r.y + r.height);
      expect_drawn_rect(image, std::max(0, r.x), std::max(0, r.y), r.height > 0 ? x1 : 0, r.width > 0 ? y1 : 0);
    }
  }
}

TEST(Scissor, IntersectsWithTheViewport) {
  Image<glm::vec4> image(64, 64);
  DrawState state;
  state.viewport = Rect{10, 10, 30, 30};
  state.scissor = Rect{20, 0, 64, 25};
  draw(image, ConstantShader{}, kFullScreen, state);
  expect_drawn_rect(image, 20, 10, 40, 25);
}

// ---- provoking vertex and primitive order ----------------------------------------------------------------------

TEST(ProvokingVertex, IsIndependentOfRotationWindingAndClipping) {
  // All depths differ, so that setup starts each rotation at a different vertex. If clipped is set, the near plane cuts the triangle.
  for (const bool clipped : {false, true}) {
    const std::array<glm::vec4, 3> corners{glm::vec4(-1, -1, 0.3f, 1), glm::vec4(1, -1, clipped ? -3.0f : 0.1f, 1),
                                           glm::vec4(0, 1, 0.2f, 1)};
    for (const bool first : {false, true}) {
      for (const Winding front : {Winding::counter_clockwise, Winding::clockwise}) {
        std::array<std::size_t, 3> order{0, 1, 2};
        do {
          std::vector<glm::vec4> positions, colors;
          std::vector<float> values;
          for (const std::size_t i : order) {
            positions.push_back(corners[i]);
            colors.push_back(glm::vec4(static_cast<float>(i + 1)));
            values.push_back(static_cast<float>(i + 1));
          }
          DrawState state;
          state.provoking = first ? ProvokingVertex::first : ProvokingVertex::last;
          state.front = front;
          Image<glm::vec4> image(16, 16);
          Pass pass(16, 16, rgba32f_target(image), {});
          pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(colors)), state);
          EXPECT_EQ(pass.run(one_worker()).clipped, clipped ? 1u : 0u);
          EXPECT_EQ(pixel(image, 6, 5).x, static_cast<float>(order[first ? 0 : 2] + 1));

          Pass again(16, 16, rgba32f_target(image), {});
          again.draw(OrderShader{}, make_vertex_view(stream(positions), stream(values)), state);
          again.run(one_worker());
          EXPECT_EQ(pixel(image, 6, 5), glm::vec4(values[0], values[1], values[2], 1));
        } while (std::next_permutation(order.begin(), order.end()));
      }
    }
  }
}

// ---- load, store, post -----------------------------------------------------------------------------------------

TEST(LoadStore, ClearFillsEverything) {
  Image<glm::vec4> image(70, 40);
  ColorTarget target = rgba32f_target(image);
  target.clear_value = {0.1f, 0.2f, 0.3f, 0.4f};
  Pass pass(70, 40, target, {});
  pass.run(one_worker());
  EXPECT_TRUE(is_everywhere(image, target.clear_value));
}

template <class T, class F>
void load_keeps_what_is_not_drawn(F make_target, uint64_t seed) {
  Random r(seed);
  Image<T> image(70, 40);
  std::span<std::byte> bytes(reinterpret_cast<std::byte*>(image.data()), image.texels().size() * sizeof(T));
  for (std::byte& b : bytes) b = static_cast<std::byte>(r.integer(0, 0x7b));  // all bits of all formats, except NaN and infinity
  const Image<T> before = image;
  ColorTarget target = make_target(image);
  target.load = LoadOp::load;
  Pass pass(70, 40, target, {});
  DrawState state;
  state.scissor = Rect{20, 10, 7, 5};
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), state);
  pass.run(one_worker());
  int64_t changed = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 70; ++x) {
      const bool inside = x >= 20 && x < 27 && y >= 10 && y < 15;
      if (inside) {
        changed += pixel(image, x, y) != pixel(before, x, y);
      } else {
        ASSERT_EQ(std::memcmp(&pixel(image, x, y), &pixel(before, x, y), sizeof(T)), 0) << x << ", " << y;
      }
    }
  }
  EXPECT_EQ(changed, 35);
}

TEST(LoadStore, LoadPreservesPixelsThatAreNotDrawn) {
  load_keeps_what_is_not_drawn<glm::vec4>([](auto& i) { return rgba32f_target(i); }, 1);
  load_keeps_what_is_not_drawn<U16Vec4>([](auto& i) { return rgba16f_target(i); }, 2);
  load_keeps_what_is_not_drawn<glm::u8vec4>([](auto& i) { return rgba8_target(i); }, 3);
  load_keeps_what_is_not_drawn<glm::u8vec4>([](auto& i) { return srgb8a8_target(i); }, 4);
}

TEST(LoadStore, BlendingUsesTheLoadedColor) {
  Image<glm::vec4> image(8, 8);
  std::fill_n(image.data(), 64, glm::vec4(0.25f));
  ColorTarget target = rgba32f_target(image);
  target.load = LoadOp::load;
  Pass pass(8, 8, target, {});
  DrawState state;
  state.blend = kAdd;
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), state);
  pass.run(one_worker());
  EXPECT_TRUE(is_everywhere(image, glm::vec4(1.25f)));
}

// Without color attachments, the shader still decides which fragments are drawn, whether or not it has a visibility function.
TEST(DepthOnlyPass, ShadersDiscardFragmentsAndReplaceDepth) {
  for (const int samples : {1, 4}) {
    const auto total = static_cast<uint64_t>(64 * 64 * samples);
    // Draws a shader, and expects a number of samples that pass.
    const auto depth_of = [&](const auto& shader, uint64_t passed, bool alpha_to_coverage = false) {
      Image<float> depth(64, 64);
      Pass pass(64, 64, ColorTarget{}, d32f_target(depth), {.samples = samples});
      pass.draw(shader, make_vertex_view(stream(kFullScreen)), {.alpha_to_coverage = alpha_to_coverage, .query = 0});
      EXPECT_EQ(pass.run(one_worker()).queries.at(0), passed) << samples << " samples";
      return depth;
    };
    for (const Image<float>& depth : {depth_of(HalfShader<false>{}, total / 2), depth_of(HalfShader<true>{}, total / 2)}) {
      for (int x = 0; x < 64; ++x) EXPECT_EQ(depth.at(x, 5), x < 32 ? 0.5f : 1.0f) << x;
    }
    for (const Image<float>& depth : {depth_of(DepthShader<false>{}, total), depth_of(DepthShader<true>{}, total)}) {
      for (int x = 0; x < 64; ++x) EXPECT_EQ(depth.at(x, 5), (static_cast<float>(x) + 0.5f) / 64) << x;
    }
    depth_of(ConstantShader{glm::vec4(1, 1, 1, 0.25f)}, samples == 1 ? total : total / 4, true);
  }
}

TEST(LoadStore, StoreDontCareWritesNothing) {
  const glm::vec4 before(7.0f);
  Image<glm::vec4> image(70, 40);
  Image<float> depth(70, 40);
  std::fill_n(image.data(), 70 * 40, before);
  std::fill_n(depth.data(), 70 * 40, 0.875f);
  ColorTarget color_target = rgba32f_target(image);
  color_target.load = LoadOp::load;
  color_target.store = StoreOp::dont_care;
  DepthTarget depth_target = d32f_target(depth);
  depth_target.load = LoadOp::load;
  depth_target.store = StoreOp::dont_care;
  Pass pass(70, 40, color_target, depth_target);
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)));
  EXPECT_EQ(pass.run(one_worker()).fragments_shaded, 70u * 40u);
  EXPECT_TRUE(is_everywhere(image, before));
  for (const float z : depth.texels()) ASSERT_EQ(z, 0.875f);
}

TEST(LoadStore, StoreDontCareWritesNothingBetweenFlushes) {
  Image<glm::vec4> image(16, 16);
  Image<float> depth(16, 16);
  std::fill_n(image.data(), 256, glm::vec4(7.0f));
  std::fill_n(depth.data(), 256, 0.875f);
  ColorTarget color_target = rgba32f_target(image);
  DepthTarget depth_target = d32f_target(depth);
  color_target.load = depth_target.load = LoadOp::load;
  color_target.store = depth_target.store = StoreOp::dont_care;
  Pass pass(16, 16, color_target, depth_target, {.tuning = {.chunk_triangles = 1, .bin_budget = 1}});
  for (int i = 0; i < 100; ++i) pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)));
  EXPECT_GT(pass.run(one_worker()).flushes, 1u);
  EXPECT_TRUE(is_everywhere(image, glm::vec4(7.0f)));
  for (const float z : depth.texels()) ASSERT_EQ(z, 0.875f);
}

// A depth image that is loaded but not stored is tested against in all rounds, also in a tile in which the first round draws nothing.
TEST(LoadStore, FlushesKeepLoadedDepthThatIsNotStored) {
  Image<glm::vec4> image(128, 64);
  Image<float> depth(128, 64);
  std::fill_n(depth.data(), 128 * 64, 0.875f);
  DepthTarget depth_target = d32f_target(depth);
  depth_target.load = LoadOp::load;
  depth_target.store = StoreOp::dont_care;
  Pass pass(128, 64, rgba32f_target(image), depth_target, {.tuning = {.chunk_triangles = 1, .bin_budget = 1}});
  DrawState left, right;
  left.viewport = Rect{0, 0, 64, 64};
  right.viewport = Rect{64, 0, 64, 64};
  for (int i = 0; i < 100; ++i) pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), i < 60 ? left : right);  // depth 1/2
  const PassStatistics s = pass.run(one_worker());
  EXPECT_GT(s.flushes, 1u);
  EXPECT_EQ(s.samples_passed, 128u * 64u);  // the first draw in each half passes, and the others have the same depth
}

TEST(LoadStore, LoadDontCareLeavesUntouchedTilesUnchanged) {
  Image<glm::vec4> image(128, 64);
  std::fill_n(image.data(), 128 * 64, glm::vec4(7.0f));
  ColorTarget target = rgba32f_target(image);
  target.load = LoadOp::dont_care;
  Pass pass(128, 64, target, {});
  DrawState state;
  state.viewport = Rect{0, 0, 64, 64};  // exactly the left tile
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), state);
  EXPECT_EQ(pass.run(one_worker()).tiles_touched, 1u);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) ASSERT_EQ(pixel(image, x, y), glm::vec4(x < 64 ? 1.0f : 7.0f));
  }
  // The same test with a depth attachment that is cleared everywhere.
  Image<float> depth(128, 64);
  Pass again(128, 64, target, d32f_target(depth));
  again.draw(ConstantShader{glm::vec4(3)}, make_vertex_view(stream(kFullScreen)), state);
  again.run(one_worker());
  EXPECT_EQ(pixel(image, 10, 10), glm::vec4(3));
  EXPECT_EQ(pixel(image, 100, 10), glm::vec4(7));
  EXPECT_EQ(pixel(depth, 10, 10), 0.5f);
  EXPECT_EQ(pixel(depth, 100, 10), 1.0f);
}

TEST(LoadStore, APassIsEmptyAfterItsRun) {
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  pass.draw(ConstantShader{glm::vec4(1)}, make_vertex_view(stream(kFullScreen)));
  EXPECT_EQ(pass.run(one_worker()).primitives_in, 1u);
  EXPECT_EQ(pass.run(one_worker()).primitives_in, 0u);
  EXPECT_TRUE(is_everywhere(image, glm::vec4(0)));
  pass.draw(ConstantShader{glm::vec4(2)}, make_vertex_view(stream(kFullScreen)));
  pass.run(one_worker());
  EXPECT_TRUE(is_everywhere(image, glm::vec4(2)));
}

TEST(LoadStore, TargetsDoNotNeedImages) {
  // Color and depth exist only in tile memory; only the post target is written.
  Image<glm::u8vec4> out(70, 40);
  Pass pass(70, 40, {.format = ColorFormat::rgba16f, .store = StoreOp::dont_care}, {.format = DepthFormat::d32f});
  pass.draw(ConstantShader{glm::vec4(0.5f)}, make_vertex_view(stream(kFullScreen)));
  pass.post([]<class R>(const vec4<R>& c) { return c * R(2); }, rgba8_target(out));
  pass.run(one_worker());
  for (const glm::u8vec4& p : out.texels()) ASSERT_EQ(p, glm::u8vec4(255));
}

TEST(PostDeathTest, RequiresAColorAttachment) {
  Image<float> depth(8, 8);
  Image<glm::u8vec4> out(8, 8);
  Pass pass(8, 8, {}, d32f_target(depth));
  EXPECT_DEATH(pass.post([]<class R>(const vec4<R>& c) { return c; }, rgba8_target(out)), "no color target");
}

TEST(Post, RunsOnEveryPixelOnce) {
  Image<glm::vec4> image(70, 40), out(70, 40);
  ColorTarget target = rgba32f_target(image);
  target.clear_value = glm::vec4(1, 2, 3, 4);
  Pass pass(70, 40, target, {}, {.tuning = {.tile_size = 32}});
  DrawState state;
  state.scissor = Rect{0, 0, 35, 40};
  pass.draw(ConstantShader{glm::vec4(5, 6, 7, 8)}, make_vertex_view(stream(kFullScreen)), state);
  pass.post([]<class R>(const vec4<R>& c) { return vec4<R>(c.y, c.x, c.w, c.z + R(1)); }, rgba32f_target(out));
  pass.run(one_worker());
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 70; ++x) {
      ASSERT_EQ(pixel(image, x, y), x < 35 ? glm::vec4(5, 6, 7, 8) : glm::vec4(1, 2, 3,
                                                                               4));  // the color itself is stored unchanged
      ASSERT_EQ(pixel(out, x, y), x < 35 ? glm::vec4(6, 5, 8, 8) : glm::vec4(2, 1, 4, 4));
    }
  }
}

// ---- statistics ------------------------------------------------------------------------------------------------

TEST(Statistics, CountOneTriangleInFourTiles) {
  Image<glm::vec4> image(128, 128);
  const PassStatistics s = draw(image, ConstantShader{}, kFullScreen);
  PassStatistics want;
  want.vertices_in = 3;
  want.vertices_shaded = 3;
  want.primitives_in = 1;
  want.triangles_binned = 1;
  want.bin_entries = 4;
  want.samples_tested = 128 * 128;
  want.samples_passed = 128 * 128;
  want.fragments_shaded = 128 * 128;
  want.tiles_touched = 4;
  EXPECT_EQ(s, want);
}

TEST(Statistics, CountEachReasonForCulling) {
  const auto count = [](const std::vector<glm::vec4>& p, CullMode cull = CullMode::none) {
    Image<glm::vec4> image(64, 64);
    DrawState state;
    state.cull = cull;
    return draw(image, ConstantShader{}, p, state);
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(count({{nan, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}).culled_non_finite, 1u);
  // beyond the right side; beyond the far plane; behind the eye; clipped away by the near and guard planes
  EXPECT_EQ(count({{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}}).culled_outside, 1u);
  EXPECT_EQ(count({{0, 0, 2, 1}, {1, 0, 2, 1}, {0, 1, 2, 1}}).culled_outside, 1u);
  EXPECT_EQ(count({{0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -1}}).culled_outside, 1u);
  EXPECT_EQ(count({{-1, 0, -3, 1}, {2000, 0, 0, -1}, {-2000, 1, 0, -1}}).culled_outside, 1u);
  EXPECT_EQ(count({{-1, -1, 0, 1}, {0, 1, 0, 1}, {1, -1, 0, 1}}, CullMode::back).culled_face, 1u);
  EXPECT_EQ(count({{-1, -1, 0, 1}, {0, 0, 0, 1}, {1, 1, 0, 1}}).culled_degenerate, 1u);
  // a triangle of half a pixel between pixel centers
  EXPECT_EQ(count({{1.0f / 32, 0, 0, 1}, {1.4f / 32, 0, 0, 1}, {1.2f / 32, 0.4f / 32, 0, 1}}).culled_no_sample, 1u);
  for (const auto& s : {count({{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}}), count({{-1, -1, 0, 1}, {0, 0, 0, 1}, {1, 1, 0, 1}})}) {
    EXPECT_EQ(s.primitives_in, 1u);
    EXPECT_EQ(s.triangles_binned + s.bin_entries + s.samples_tested + s.fragments_shaded + s.tiles_touched + s.clipped, 0u);
  }
  // clipped by the near plane into a quad: one clipped, two binned
  const PassStatistics quad = count({{-1, -1, -3, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}});
  EXPECT_EQ(quad.clipped, 1u);
  EXPECT_EQ(quad.triangles_binned, 2u);
  EXPECT_EQ(quad.bin_entries, 2u);
  EXPECT_EQ(quad.tiles_touched, 1u);
  // clipped, then culled by its facing: counted once
  const PassStatistics both = count({{-1, -1, -3, 1}, {0, 1, 0, 1}, {1, -1, 0, 1}}, CullMode::back);
  EXPECT_EQ(both.clipped, 1u);
  EXPECT_EQ(both.culled_face, 1u);
  EXPECT_EQ(both.triangles_binned, 0u);
}

TEST(Statistics, DeferredDrawsShadeOnlyVisibleFragments) {
  // Draws the far layer before the near one, then the near one before the far one, with 64 × 64 samples per layer.
  for (const bool near_first : {false, true}) {
    for (const bool defer : {true, false}) {
      const auto first = full_screen(near_first ? -0.5f : 0.5f), second = full_screen(near_first ? 0.5f : -0.5f);
      Image<glm::vec4> image(64, 64);
      Pass pass(64, 64, rgba32f_target(image), {.format = DepthFormat::d32f}, {.tuning = {.defer = defer}});
      pass.draw(ConstantShader{glm::vec4(1)}, make_vertex_view(stream(first)));
      pass.draw(ConstantShader{glm::vec4(2)}, make_vertex_view(stream(second)));
      const PassStatistics s = pass.run(one_worker());
      // A block that a layer covers completely has exact depth bounds, so the layer behind it is rejected by block.
      EXPECT_EQ(s.samples_tested, near_first ? 4096u : 8192u);
      EXPECT_EQ(s.samples_passed, near_first ? 4096u : 8192u);
      EXPECT_EQ(s.fragments_shaded, near_first || defer ? 4096u : 8192u);
      EXPECT_EQ(s.tiles_touched, 1u);
      EXPECT_EQ(s.bin_entries, 2u);
      EXPECT_TRUE(is_everywhere(image, glm::vec4(near_first ? 1.0f : 2.0f)));
    }
  }
}

TEST(Statistics, OccludedBlocksAreNotTested) {
  // Draws eight layers from far to near. The bounds of each block are then made exact, so that the eight layers behind them are rejected
  // block by block.
  std::vector<glm::vec4> positions;
  for (int layer = 0; layer < 16; ++layer) {
    const auto p = full_screen(layer < 8 ? 0.5f - 0.1f * static_cast<float>(layer) : 0.6f);
    positions.insert(positions.end(), p.begin(), p.end());
  }
  Image<glm::vec4> image(64, 64);
  Pass pass(64, 64, rgba32f_target(image), {.format = DepthFormat::d32f});
  pass.draw(ConstantShader{}, make_vertex_view(stream(positions)));
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s.samples_tested, 8u * 4096u);
  EXPECT_EQ(s.samples_passed, 8u * 4096u);
  EXPECT_EQ(s.fragments_shaded, 4096u);
}

TEST(Statistics, FlushesAreCountedAndDoNotChangeTheResult) {
  Random r(1);
  std::vector<glm::vec4> positions, colors;
  for (int i = 0; i < 3 * 200; ++i) {
    positions.push_back({r.real(-1.5f, 1.5f), r.real(-1.5f, 1.5f), r.real(-1.0f, 1.0f), 1});
    colors.push_back({r.real(0.0f, 1.0f), 0, 0, 1});
  }
  PassStatistics statistics[2];
  Image<glm::vec4> images[2]{Image<glm::vec4>(100, 80), Image<glm::vec4>(100, 80)};
  Image<float> depths[2]{Image<float>(100, 80), Image<float>(100, 80)};
  for (const int small_budget : {0, 1}) {
    PassOptions options{.tuning = {.chunk_triangles = 2}};
    if (small_budget) options.tuning.bin_budget = 1;
    Pass pass(100, 80, rgba32f_target(images[small_budget]), d32f_target(depths[small_budget]), options);
    pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(colors)));
    statistics[small_budget] = pass.run(one_worker());
  }
  EXPECT_EQ(statistics[0].flushes, 0u);
  EXPECT_EQ(statistics[1].flushes,
            3u);  // 100 chunks in waves of 32: four rounds
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(depths[0], depths[1]);
  EXPECT_EQ(statistics[0].primitives_in, statistics[1].primitives_in);
  EXPECT_EQ(statistics[0].bin_entries, statistics[1].bin_entries);
  EXPECT_EQ(statistics[0].vertices_shaded, 600u);

  // Between flushes, the pass keeps attachments without images in its own memory.
  Image<glm::vec4> posted(100, 80);
  Pass pass(100, 80, {.format = ColorFormat::rgba32f, .store = StoreOp::dont_care}, {.format = DepthFormat::d32f},
            {.tuning = {.chunk_triangles = 2, .bin_budget = 1}});
  pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(colors)));
  pass.post([]<class R>(const vec4<R>& c) { return c; }, rgba32f_target(posted));
  EXPECT_EQ(pass.run(one_worker()).flushes, 3u);
  EXPECT_EQ(posted, images[0]);
}

// The vertices of later draws take over the memory of finished draws. The draws differ in size, and a chunk contains parts of several.
TEST(Statistics, VerticesOfAllDrawsNeedNotFitIntoMemory) {
  Random r(2);
  std::vector<std::vector<glm::vec4>> positions(60), colors(60);
  for (std::size_t d = 0; d < positions.size(); ++d) {
    const int triangles = r.between(0, 40) * r.between(0, 40);
    for (int i = 0; i < 3 * triangles; ++i) {
      positions[d].push_back({r.real(-1.5f, 1.5f), r.real(-1.5f, 1.5f), r.real(-1.0f, 1.0f), 1});
      colors[d].push_back({r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), 0, 1});
    }
  }
  const auto render = [&](Image<glm::vec4>& image, std::size_t budget, uint32_t chunk_triangles, const Workers& workers) {
    Pass pass(100, 80, rgba32f_target(image), {.format = DepthFormat::d32f},
              {.tuning = {.chunk_triangles = chunk_triangles, .bin_budget = budget}});
    for (std::size_t d = 0; d < positions.size(); ++d)
      pass.draw(FlatColorShader{}, make_vertex_view(stream(positions[d]), stream(colors[d])));
    return pass.run(workers).flushes;
  };
  Image<glm::vec4> expected(100, 80);
  EXPECT_EQ(render(expected, std::size_t{1} << 30, 100, one_worker()), 0u);
  for (const std::size_t budget : {std::size_t{1}, std::size_t{20000}, std::size_t{200000}}) {
    for (const uint32_t chunk_triangles : {7u, 100u, 5000u}) {
      Image<glm::vec4> image(100, 80);
      EXPECT_GE(render(image, budget, chunk_triangles, Workers(2)), 2u) << budget << " " << chunk_triangles;
      EXPECT_EQ(image, expected) << budget << " " << chunk_triangles;
    }
  }
}

// ---- shaders that decide visibility ----------------------------------------------------------------------------

TEST(Discard, DropsColorAndDepth) {
  const auto run = [](const auto& shader, bool blended) {
    Image<glm::vec4> image(64, 64);
    Image<float> depth(64, 64);
    Pass pass(64, 64, rgba32f_target(image), d32f_target(depth));
    DrawState state;
    if (blended) state.blend = kAdd;
    pass.draw(shader, make_vertex_view(stream(kFullScreen)), state);
    const PassStatistics s = pass.run(one_worker());
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        ASSERT_EQ(pixel(image, x, y).x, x < 32 ? 1.0f : 0.0f);
        ASSERT_EQ(pixel(depth, x, y), x < 32 ? 0.5f : 1.0f);
      }
    }
    EXPECT_EQ(s.samples_passed, 64u * 32u);
  };
  for (const bool blended : {false, true}) {
    run(HalfShader<false>{}, blended);
    run(HalfShader<true>{}, blended);
  }
}

TEST(ShaderDepth, ReplacesTheInterpolatedDepth) {
  const auto run = [](const auto& shader, bool blended) {
    Image<glm::vec4> image(64, 64);
    Image<float> depth(64, 64);
    Pass pass(64, 64, rgba32f_target(image), d32f_target(depth));
    DrawState state;
    state.depth.range_far = 0.875f;  // shader-written depth is clamped to the range
    if (blended) state.blend = kAdd;
    auto second = shader;
    second.color = glm::vec4(2);
    second.scale = -second.scale;
    second.bias = 1;
    pass.draw(shader, make_vertex_view(stream(kFullScreen)), state);
    pass.draw(second, make_vertex_view(stream(kFullScreen)),
              state);  // 1 − x/64: nearer in the right half
    pass.run(one_worker());
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const float a = std::min((static_cast<float>(x) + 0.5f) / 64, 0.875f),
                    b = std::min(1 - (static_cast<float>(x) + 0.5f) / 64, 0.875f);
        ASSERT_EQ(pixel(depth, x, y), std::min(a, b)) << x;
        ASSERT_EQ(pixel(image, x, y).x, b < a ? (blended ? 3.0f : 2.0f) : 1.0f) << x;
      }
    }
  };
  for (const bool blended : {false, true}) {
    run(DepthShader<false>{}, blended);
    run(DepthShader<true>{}, blended);
  }
}

// ---- vertices and indices --------------------------------------------------------------------------------------

struct Vertex {
  glm::vec4 color;
  glm::vec2 unused;
  glm::vec4 position;
};

TEST(VertexView, InterleavedMatchesSeparateStreams) {
  Random r(2);
  std::vector<Vertex> interleaved;
  std::vector<glm::vec4> positions, colors;
  for (int i = 0; i < 300; ++i) {
    positions.push_back({r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), 1});
    colors.push_back({r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), 1});
    interleaved.push_back({colors.back(), {9, 9}, positions.back()});
  }
  Image<glm::vec4> a(50, 50), b(50, 50);
  Pass pass_a(50, 50, rgba32f_target(a), {.format = DepthFormat::d32f});
  pass_a.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(colors)));
  pass_a.run(one_worker());
  Pass pass_b(50, 50, rgba32f_target(b), {.format = DepthFormat::d32f});
  pass_b.draw(FlatColorShader{}, make_vertex_view(stream(interleaved, &Vertex::position), stream(interleaved, &Vertex::color)));
  pass_b.run(one_worker());
  EXPECT_EQ(a, b);
  EXPECT_GT(drawn_pixels(a), 1000);
}

TEST(VertexView, MemberThatIsOneFloat) {
  struct Weighted {
    glm::vec2 position;
    float weight;
  };
  const std::vector<Weighted> list{{{1, 2}, 3}, {{4, 5}, 6}};
  const StreamOf<float> weights = stream(list, &Weighted::weight);
  EXPECT_EQ(weights.components, 1);
  EXPECT_EQ(weights.stride, 12);
  float second = 0.0f;
  read_row(weights, 1, &second);
  EXPECT_EQ(second, 6.0f);
}

TEST(Indices, AllIndexTypesDrawTheSame) {
  Random r(3);
  std::vector<glm::vec4> positions, unrolled;
  for (int i = 0; i < 1000; ++i) positions.push_back({r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), 1});
  std::vector<uint16_t> narrow;
  std::vector<uint32_t> wide;
  for (int i = 0; i < 100; ++i) {
    const int k = r.integer(300, 399) * (i == 0 ? 1 : 2) % 700 + 100;  // with gaps: many vertices are unused
    narrow.push_back(static_cast<uint16_t>(k));
    wide.push_back(static_cast<uint32_t>(k));
    unrolled.push_back(positions[static_cast<std::size_t>(k)]);
  }
  std::vector<uint32_t> distinct = wide;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  DrawState state;
  state.blend = kAdd;
  Image<glm::vec4> image[3]{Image<glm::vec4>(40, 40), Image<glm::vec4>(40, 40), Image<glm::vec4>(40, 40)};
  const Indices by_narrow(narrow, positions.size()), by_wide(wide, positions.size());
  for (int i = 0; i < 3; ++i) {
    Pass pass(40, 40, rgba32f_target(image[i]), {});
    if (i == 0) pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), by_narrow, state);
    if (i == 1) pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), by_wide, state);
    if (i == 2) pass.draw(ConstantShader{}, make_vertex_view(stream(unrolled)), state);
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.primitives_in, 33u);  // 100 indices: the last one is ignored
    EXPECT_EQ(s.vertices_shaded, i == 2 ? 100u : distinct.size());
  }
  EXPECT_EQ(image[0], image[1]);
  EXPECT_EQ(image[0], image[2]);
  EXPECT_GT(drawn_pixels(image[0]), 500);
}

TEST(Indices, EmptyListsDrawNothing) {
  const std::vector<uint32_t> none;
  const std::vector<glm::vec4> no_vertices;
  Image<glm::vec4> image(16, 16);
  const Indices empty(none, 3);
  Pass pass(16, 16, rgba32f_target(image), {});
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), empty);
  pass.draw(ConstantShader{}, make_vertex_view(stream(no_vertices)));
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s, PassStatistics{});
  EXPECT_EQ(drawn_pixels(image), 0);
}

TEST(Indices, ReportTheirRange) {
  const std::vector<uint32_t> list{7, 3, 9, 3};
  const Indices i(list, 10);
  EXPECT_EQ(i.size(), 4u);
  EXPECT_EQ(i.first_vertex(), 3u);
  EXPECT_EQ(i.end_vertex(), 10u);
  EXPECT_EQ(i.used_count(), 3u);
  EXPECT_EQ(std::vector<uint32_t>(i.used().begin(), i.used().end()), (std::vector<uint32_t>{3, 7, 9}));
  const std::vector<uint32_t> dense{5, 4, 6, 5};
  EXPECT_TRUE(Indices(dense, 7).used().empty());
  EXPECT_EQ(Indices(dense, 7).used_count(), 3u);
}

// ---- depth-only draws ------------------------------------------------------------------------------------------

template <class S>
Image<float> depth_of(const S& shader, bool with_color) {
  Image<glm::vec4> color(64, 64);
  Image<float> depth(64, 64);
  const std::vector<ColorTarget> colors(with_color ? 1 : 0, rgba32f_target(color));
  DrawState state;
  state.depth.compare = CompareOp::always;
  Pass pass(64, 64, colors, d32f_target(depth));
  pass.draw_depth(shader, make_vertex_view(stream(kFullScreen)), state);
  pass.run(one_worker());
  return depth;
}

TEST(DepthOnlyDraw, RunsTheVisibilityFunctionInAnyPass) {
  for (const bool with_color : {false, true}) {
    const Image<float> half = depth_of(HalfShader<true>{}, with_color), own = depth_of(DepthShader<true>{}, with_color);
    for (int x = 0; x < 64; ++x) {
      EXPECT_EQ(half.at(x, 20), x < 32 ? 0.5f : 1.0f) << x << ' ' << with_color;
      EXPECT_EQ(own.at(x, 20), (static_cast<float>(x) + 0.5f) / 64) << x << ' ' << with_color;
    }
  }
}

// ---- misuse ----------------------------------------------------------------------------------------------------

TEST(StateDeathTest, ChecksVerticesAndIndices) {
  const std::vector<glm::vec4> four(4), five(5);
  const std::vector<uint32_t> list{0, 1, 4};
  EXPECT_DEATH(make_vertex_view(stream(four), stream(five)), "\\(5 vs 4\\)");
  EXPECT_DEATH(Indices(list, 4), "index is too large.*\\(4 vs 4\\)");
  const std::vector<uint16_t> narrow{0, 1, 9};
  EXPECT_DEATH(Indices(narrow, 9), "check failed");
  EXPECT_DEATH(Indices::sequential(std::size_t{1} << 32), "check failed");
  // The stream is longer than 32-bit gather indices can address. Only a view is created; nothing is read.
  const VertexStream huge{std::as_bytes(std::span(four)).data(), 16, 4, std::size_t{1} << 29};
  EXPECT_DEATH(make_vertex_view(huge), "check failed");
  VertexStream of_one = stream(four);
  of_one.missing = 4;
  EXPECT_DEATH(make_vertex_view(of_one), "number of missing components");
  EXPECT_DEATH(make_vertex_view(bgra(stream(four))), "expected four normalized bytes");
}

TEST(StateDeathTest, ChecksPasses) {
  Image<glm::vec4> image(16, 16);
  EXPECT_DEATH(Pass(0, 16, rgba32f_target(image), {}), "check failed");
  EXPECT_DEATH(Pass(16, 16385, rgba32f_target(image), {}), "check failed");
  EXPECT_DEATH(Pass(16, 16, rgba32f_target(image), {}, {.tuning = {.tile_size = 24}}), "check failed");
  EXPECT_DEATH(Pass(16, 16, rgba32f_target(image), {}, {.tuning = {.chunk_triangles = 0}}), "check failed");
  EXPECT_DEATH(Pass(16, 16, rgba32f_target(image), {}, {.tuning = {.chunk_triangles = 8193}}), "check failed");
  EXPECT_DEATH(Pass(16, 16, {.format = ColorFormat::rgba8}, {}),
               "check failed");  // would be stored, but has no image
  EXPECT_DEATH(Pass(16, 16, {.format = ColorFormat::rgba8, .load = LoadOp::load, .store = StoreOp::dont_care}, {}), "check failed");
  EXPECT_DEATH(Pass(16, 16, {}, {.format = DepthFormat::d32f, .load = LoadOp::load}), "check failed");
  EXPECT_DEATH(Pass(16, 16, {}, {.format = DepthFormat::d32f, .store = StoreOp::store}), "check failed");
}

TEST(StateDeathTest, ChecksDraws) {
  Image<glm::vec4> image(16, 16);
  const std::vector<glm::vec4> p(3), q(6);
  const std::vector<uint32_t> list{0, 1, 5};
  const Indices of_six(list, 6);
  const auto draw_with = [&](const std::function<void(DrawState&)>& change) {
    Pass pass(16, 16, rgba32f_target(image), {});
    DrawState state;
    change(state);
    pass.draw(ConstantShader{}, make_vertex_view(stream(p)), state);
  };
  EXPECT_DEATH(Pass(16, 16, rgba32f_target(image), {}).draw(ConstantShader{}, make_vertex_view(stream(p)), of_six), "check failed");
  const VertexView untyped = make_vertex_view(stream(p));  // untyped, so that the compiler does not check the streams
  EXPECT_DEATH(Pass(16, 16, rgba32f_target(image), {}).draw(FlatColorShader{}, untyped), "do not match the attributes");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = Rect{0, 0, 0, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = Rect{0, 0, 16385, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = Rect{20000, 0, 16, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = ViewportRect{0, 0, -16, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = ViewportRect{0, std::nanf(""), 16, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.viewport = ViewportRect{0, 0, 16, 0.001f}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.scissor = Rect{0, 0, -1, 16}; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.depth.range_near = -0.1f; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.depth.range_far = 1.1f; }), "check failed");
  EXPECT_DEATH(draw_with([](DrawState& s) { s.depth.range_far = std::numeric_limits<float>::quiet_NaN(); }), "check failed");
}

TEST(State, DepthOnlyDrawsLeaveColorUnchanged) {
  Image<glm::vec4> image(16, 16);
  Image<float> depth(16, 16);
  const std::vector<uint32_t> list{0, 1, 2};
  const Indices indices(list, 3);
  Pass pass(16, 16, rgba32f_target(image), d32f_target(depth));
  pass.draw(ConstantShader{}, make_vertex_view(stream(kFullScreen)), {.depth = {.test = false}});
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(kFullScreen)), indices);
  pass.run(one_worker());
  EXPECT_EQ(image.at(3, 3), glm::vec4(1.0f));
  EXPECT_LT(depth.at(3, 3), 1.0f);
}

}  // namespace
}  // namespace halfspace::raster_test
