// SPDX-License-Identifier: Apache-2.0
//
// Tests color masks, blend factors, stencil, multiple attachments and occlusion queries with hand-computed values.
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

// Returns a triangle that covers any render target, at a window depth in [0, 1].
std::vector<glm::vec4> whole(float depth) { return full_screen(2.0f * depth - 1.0f); }

// Outputs N colors: output n is colors[n].
template <std::size_t N>
struct NumberedColors {
  std::array<glm::vec4, N> colors{};
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
  template <class R>
  FragmentMRT<R, N> fragment(const Varyings<R>&, const Pixel<R>&) const {
    FragmentMRT<R, N> out;
    for (std::size_t i = 0; i < N; ++i) out.color[i] = vec4<R>(R(colors[i].x), R(colors[i].y), R(colors[i].z), R(colors[i].w));
    return out;
  }
};

TEST(Operations, ColorMaskAlsoAppliesToDeferredDraws) {
  Image<glm::u8vec4> image(9, 5);
  const std::vector<glm::vec4> p = whole(0.5f);
  Pass pass(9, 5, rgba8_target(image), {});
  pass.draw(ConstantShader{glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)}, make_vertex_view(stream(p)));
  pass.draw(ConstantShader{glm::vec4(1.0f)}, make_vertex_view(stream(p)), {.color_mask = {false, true, false, true}});
  pass.run(one_worker());
  for (int i = 0; i < 45; ++i) EXPECT_EQ(image.data()[i], (glm::u8vec4{51, 255, 153, 255}));
}

TEST(Operations, BlendFactorsMatchHandComputedValues) {
  const glm::vec4 src{0.5f, 0.25f, 1.0f, 0.5f}, dst{0.25f, 0.5f, 0.75f, 0.25f}, constant{0.5f, 0.0f, 1.0f, 0.75f};
  struct Case {
    BlendFactor factor;
    glm::vec4 expected;  // source color times factor
  };
  const Case cases[] = {{BlendFactor::constant_color, {0.25f, 0.0f, 1.0f, 0.375f}},
                        {BlendFactor::one_minus_constant_color, {0.25f, 0.25f, 0.0f, 0.125f}},
                        {BlendFactor::constant_alpha, src * 0.75f},
                        {BlendFactor::one_minus_constant_alpha, src * 0.25f},
                        {BlendFactor::src_alpha_saturate, {0.25f, 0.125f, 0.5f, 0.5f}},  // min(0.5, 1 − 0.25); alpha: 1
                        {BlendFactor::dst_color, src * dst},
                        {BlendFactor::one_minus_dst_alpha, src * 0.75f}};
  const std::vector<glm::vec4> p = whole(0.5f);
  for (const Case& c : cases) {
    Image<glm::vec4> image(3, 3);
    ColorTarget target = rgba32f_target(image);
    target.clear_value = dst;
    Pass pass(3, 3, target, {});
    pass.draw(
        ConstantShader{src}, make_vertex_view(stream(p)),
        {.blend = BlendState{BlendEquation::add, c.factor, BlendFactor::zero, BlendEquation::add, c.factor, BlendFactor::zero, constant}});
    pass.run(one_worker());
    EXPECT_EQ(image.at(1, 1), c.expected) << static_cast<int>(c.factor);
  }
}

// OpenGL 4.6, section 17.3.9: sRGB attachments are blended in linear space. White over black with a weight of 1/2 gives the sRGB encoding
// of 0.5.
TEST(Operations, SrgbIsBlendedInLinearLight) {
  Image<glm::u8vec4> image(3, 3);
  const std::vector<glm::vec4> p = whole(0.5f);
  Pass pass(3, 3, srgb8a8_target(image), {});
  pass.draw(ConstantShader{glm::vec4(1.0f, 1.0f, 1.0f, 0.5f)}, make_vertex_view(stream(p)), {.blend = BlendState{}});
  pass.run(one_worker());
  EXPECT_EQ(image.at(1, 1), (glm::u8vec4{188, 188, 188, 128}));  // 255·encode(0.5) = 187.5…
}

TEST(Operations, DualSourceBlendingUsesBothColors) {
  Image<glm::vec4> image(3, 3);
  ColorTarget target = rgba32f_target(image);
  target.clear_value = {0.5f, 0.5f, 0.5f, 0.5f};
  const std::vector<glm::vec4> p = whole(0.5f);
  Pass pass(3, 3, target, {});
  // A color and a per-channel transmittance, as for colored glass.
  pass.draw(NumberedColors<2>{{glm::vec4{0.125f, 0, 0, 1}, glm::vec4{0.5f, 0.25f, 0, 0}}}, make_vertex_view(stream(p)),
            {.blend = BlendState{BlendEquation::add, BlendFactor::one, BlendFactor::src1_color, BlendEquation::add, BlendFactor::one,
                                 BlendFactor::one_minus_src1_alpha}});
  pass.run(one_worker());
  EXPECT_EQ(image.at(1, 1), (glm::vec4{0.375f, 0.125f, 0.0f, 1.5f}));
}

TEST(Operations, EachAttachmentHasItsOwnFormatBlendingAndMask) {
  Image<glm::vec4> a(20, 9), c(20, 9);
  Image<glm::u8vec4> b(20, 9), d(20, 9);
  std::array<ColorTarget, 4> targets{rgba32f_target(a), rgba8_target(b), rgba32f_target(c), srgb8a8_target(d)};
  targets[2].clear_value = {1, 2, 3, 4};
  targets[3].clear_value = glm::vec4(1.0f);
  const std::vector<glm::vec4> p = whole(0.5f);
  Pass pass(20, 9, targets, {});
  const NumberedColors<3> shader{{glm::vec4{0, 0.25f, 0.5f, 1}, glm::vec4{1, 0, 0.2f, 1}, glm::vec4{2, 2, 2, 2}}};
  DrawState state;
  state.attachments[2] = AttachmentState{.blend = kAdd, .mask = {true, true, true, false}};
  pass.draw(shader, make_vertex_view(stream(p)), state);
  pass.run(one_worker());
  EXPECT_EQ(a.at(19, 8), (glm::vec4{0, 0.25f, 0.5f, 1}));
  EXPECT_EQ(b.at(19, 8), (glm::u8vec4{255, 0, 51, 255}));
  EXPECT_EQ(c.at(19, 8), (glm::vec4{3, 4, 5, 4}));
  EXPECT_EQ(d.at(19, 8), (glm::u8vec4{255, 255, 255, 255}));  // the shader has no fourth output
}

// Uses the stencil operations to mark samples. Samples that fail the stencil test, fail the depth test, or pass both get three different
// values.
void expect_stencil_operations(int samples, const std::optional<BlendState>& blend) {
  Image<uint32_t> depth(8, 8);
  Image<glm::vec4> image(8, 8);
  DepthTarget target = d24s8_target(depth);
  target.stencil_clear_value = 7;
  Pass pass(8, 8, rgba32f_target(image), target, {.samples = samples});
  const std::vector<glm::vec4> near = whole(0.25f), far = whole(0.75f);
  const Rect left{0, 0, 4, 8}, top{0, 4, 8, 4};
  pass.draw(ConstantShader{}, make_vertex_view(stream(near)), {.scissor = left, .blend = blend});
  const StencilFace marked{.compare = CompareOp::equal, .reference = 7};
  const StencilFace mark{.pass = StencilOp::replace, .reference = 5};
  pass.draw(ConstantShader{}, make_vertex_view(stream(far)),
            {.scissor = top, .depth = {.test = false}, .stencil = StencilState{mark, mark}, .blend = blend});
  StencilFace count = marked;
  count.fail = StencilOp::invert;                 // ~5 = 250
  count.depth_fail = StencilOp::increment_clamp;  // 8
  count.pass = StencilOp::decrement_wrap;         // 6
  pass.draw(ConstantShader{}, make_vertex_view(stream(far)), {.stencil = StencilState{count, count}, .blend = blend});
  pass.run(one_worker());
  EXPECT_EQ(pixel(depth, 6, 6) & 0xff, 250u);
  EXPECT_EQ(pixel(depth, 1, 6) & 0xff, 250u);
  EXPECT_EQ(pixel(depth, 1, 1) & 0xff, 8u);
  EXPECT_EQ(pixel(depth, 6, 1) & 0xff, 6u);
  EXPECT_EQ(pixel(depth, 6, 1) >> 8, 12582911u);  // 0.75 · (2^24 − 1), rounded to the nearest even
  EXPECT_EQ(pixel(depth, 1, 1) >> 8, 4194304u);
}

TEST(Operations, StencilDistinguishesFailDepthFailAndPass) {
  for (const int samples : {1, 4}) {
    for (const std::optional<BlendState>& blend : {std::optional<BlendState>(), std::optional(kAlphaBlend)}) {
      SCOPED_TRACE(std::to_string(samples) + " samples" + (blend ? ", blended" : ""));
      expect_stencil_operations(samples, blend);
    }
  }
}

// Draws primitives that cover every pixel once over an image whose left half has stencil value 1. Only this value passes the stencil test,
// which does not change it. Adds 1 to the pixels that pass.
Image<glm::vec4> add_where_marked(const std::vector<glm::vec4>& positions, Topology topology) {
  Image<glm::vec4> image(16, 16);
  Image<uint32_t> depth(16, 16);
  Pass pass(16, 16, rgba32f_target(image), d24s8_target(depth));
  const std::vector<glm::vec4> everywhere = whole(0.5f);
  const StencilFace mark{.pass = StencilOp::replace, .reference = 1}, marked{.compare = CompareOp::equal, .reference = 1};
  pass.draw(ConstantShader{}, make_vertex_view(stream(everywhere)),
            {.scissor = Rect{0, 0, 8, 16},
             .depth = {.test = false},
             .stencil = StencilState{mark, mark},
             .color_mask = {false, false, false, false}});
  pass.draw(ConstantShader{}, make_vertex_view(stream(positions)),
            {.topology = topology, .depth = {.test = false}, .stencil = StencilState{marked, marked}, .blend = kAdd, .query = 0});
  EXPECT_EQ(pass.run(one_worker()).queries[0], 8u * 16);
  return image;
}

// The rasterizer runs the stencil test of thin lines and tiny triangles for one pixel at a time.
TEST(Operations, StencilThatIsOnlyReadSelectsPixelsOfThinLinesAndTinyTriangles) {
  const auto expect_left_half = [](const Image<glm::vec4>& image) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) EXPECT_EQ(pixel(image, x, y).x, x < 8 ? 1.0f : 0.0f) << x << ' ' << y;
    }
  };
  std::vector<glm::vec4> lines, triangles;
  for (int y = 0; y < 16; ++y) {
    const int center = y * 256 + 128;
    for (const int x : {-256, 17 * 256}) lines.push_back(clip_position({x, center}, 16, 16));
    for (int x = 128; x < 16 * 256; x += 256) {
      for (const Point& p : {Point{x - 60, center - 60}, {x + 60, center - 60}, {x, center + 60}})
        triangles.push_back(clip_position(p, 16, 16));
    }
  }
  expect_left_half(add_where_marked(lines, Topology::lines));
  expect_left_half(add_where_marked(triangles, Topology::triangles));
}

TEST(Operations, StencilFacesAndMasksAreSeparate) {
  Image<DepthStencil> depth(8, 8);
  Image<glm::vec4> image(8, 8);
  Pass pass(8, 8, rgba32f_target(image), d32fs8_target(depth));
  std::vector<glm::vec4> front = whole(0.5f), back = front;
  std::swap(back[1], back[2]);
  const StencilState state{.front = {.pass = StencilOp::replace, .reference = 0xff, .write_mask = 0x0f},
                           .back = {.pass = StencilOp::replace, .reference = 0xa5, .write_mask = 0xf0}};
  pass.draw(ConstantShader{}, make_vertex_view(stream(front)), {.stencil = state});
  pass.draw(ConstantShader{}, make_vertex_view(stream(back)), {.scissor = Rect{0, 0, 4, 8}, .depth = {.test = false}, .stencil = state});
  pass.run(one_worker());
  EXPECT_EQ(pixel(depth, 6, 1), (DepthStencil{0.5f, 0x0f}));
  EXPECT_EQ(pixel(depth, 1, 1), (DepthStencil{0.5f, 0xaf}));
}

TEST(Operations, QueriesCountPassingSamples) {
  for (const bool defer : {true, false}) {
    Image<glm::vec4> image(100, 70);
    Pass pass(100, 70, rgba32f_target(image), {.format = DepthFormat::d32f}, {.tuning = {.defer = defer}});
    const std::vector<glm::vec4> near = whole(0.25f), middle = whole(0.5f), far = whole(0.75f);
    pass.draw(ConstantShader{}, make_vertex_view(stream(middle)), {.scissor = Rect{3, 5, 80, 40}, .query = 0});
    pass.draw(ConstantShader{}, make_vertex_view(stream(far)), {.scissor = Rect{0, 0, 50, 70}, .query = 1});
    pass.draw(ConstantShader{}, make_vertex_view(stream(far)), {.scissor = Rect{10, 10, 20, 20}, .query = 2});
    pass.draw(ConstantShader{}, make_vertex_view(stream(near)), {.scissor = Rect{0, 0, 7, 3}, .query = 0});  // adds to query 0
    const PassStatistics s = pass.run(one_worker());
    ASSERT_EQ(s.queries.size(), 3u);
    EXPECT_EQ(s.queries[0], 80u * 40 + 7 * 3);
    EXPECT_EQ(s.queries[1], 50u * 70 - 47 * 40);
    EXPECT_EQ(s.queries[2], 0u);
    EXPECT_TRUE(s.any_passed(1));
    EXPECT_FALSE(s.any_passed(2));
  }
}

// Draws depth first, then color where the depth is equal: every pixel is shaded once, for any order of draws.
TEST(Operations, DepthPrePassShadesEveryPixelOnce) {
  Image<glm::vec4> image(64, 64);
  Pass pass(64, 64, rgba32f_target(image), {.format = DepthFormat::d32f}, {.tuning = {.defer = false}});
  const std::vector<glm::vec4> near = whole(0.25f), far = whole(0.75f);
  for (const auto* p : {&far, &near})
    pass.draw(ConstantShader{}, make_vertex_view(stream(*p)), {.color_mask = {false, false, false, false}});
  const DepthState equal{.write = false, .compare = CompareOp::equal};
  pass.draw(ConstantShader{glm::vec4(2.0f)}, make_vertex_view(stream(far)), {.depth = equal});
  pass.draw(ConstantShader{glm::vec4(1.0f)}, make_vertex_view(stream(near)), {.depth = equal});
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s.fragments_shaded, 64u * 64);
  EXPECT_EQ(image.at(10, 10), glm::vec4(1.0f));
}

}  // namespace

}  // namespace halfspace
