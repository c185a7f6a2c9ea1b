// SPDX-License-Identifier: Apache-2.0
//
// A pass refuses images that are smaller than it, and numbers that would make it write or allocate out of bounds, in one line and before
// anything is drawn.
#include <limits>

#include "halfspace/raster/naive.h"
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

class MisuseTest : public ThrowingChecksTest {
 protected:
  const std::vector<glm::vec4> positions_{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
};

/// Checks that the target of an image fits only passes of its own size, whether it is loaded, stored or both.
template <class Target>
void expect_only_own_size(const Target& target) {
  const auto message = [&](const Target& t, int width, int height, int samples) {
    return failure_of([&] {
      if constexpr (std::is_same_v<Target, ColorTarget>) {
        Pass(width, height, t, {}, {.samples = samples});
      } else {
        Pass(width, height, ColorTarget{}, t, {.samples = samples});
      }
    });
  };
  for (const auto& [load, store] :
       {std::pair(LoadOp::clear, StoreOp::store), {LoadOp::load, StoreOp::store}, {LoadOp::load, StoreOp::dont_care}}) {
    Target t = target;
    t.load = load;
    t.store = store;
    for (const int samples : {1, 4}) {
      EXPECT_EQ(message(t, 16, 8, samples), "");
      EXPECT_NE(message(t, 17, 8, samples).find("(16 vs 17)"), std::string::npos) << message(t, 17, 8, samples);
      EXPECT_NE(message(t, 16, 9, samples).find("(8 vs 9)"), std::string::npos) << message(t, 16, 9, samples);
      EXPECT_NE(message(t, 8, 16, samples), "") << "the same number of pixels, but other rows";
      EXPECT_NE(message(t, 640, 480, samples), "");
    }
    t.width = t.height = 0;  // a target made by hand, without a size
    EXPECT_NE(message(t, 16, 8, 1), "");
  }
}

template <class Pixel, class Make>
void expect_only_own_size(Make make) {
  Image<Pixel> image(16, 8);
  expect_only_own_size(make(image));
}

TEST_F(MisuseTest, ImagesOfOtherSizesAreRefused) {
  expect_only_own_size<glm::u8vec4>([](auto& i) { return rgba8_target(i); });
  expect_only_own_size<glm::u8vec4>([](auto& i) { return srgb8a8_target(i); });
  expect_only_own_size<U16Vec4>([](auto& i) { return rgba16f_target(i); });
  expect_only_own_size<glm::vec4>([](auto& i) { return rgba32f_target(i); });
  expect_only_own_size<float>([](auto& i) { return r32f_target(i); });
  expect_only_own_size<glm::vec2>([](auto& i) { return rg32f_target(i); });
  expect_only_own_size<glm::vec3>([](auto& i) { return rgb32f_target(i); });
  expect_only_own_size<uint32_t>([](auto& i) { return r32ui_target(i); });
  expect_only_own_size<uint16_t>([](auto& i) { return d16_target(i); });
  expect_only_own_size<uint32_t>([](auto& i) { return d24_target(i); });
  expect_only_own_size<uint32_t>([](auto& i) { return d24s8_target(i); });
  expect_only_own_size<DepthStencil>([](auto& i) { return d32fs8_target(i); });
  expect_only_own_size<float>([](auto& i) { return d32f_target(i); });
  expect_only_own_size<float>([](auto& i) { return d32f_target(i, 0.0f); });
}

TEST_F(MisuseTest, EveryAttachmentAndThePostTargetAreChecked) {
  Image<glm::vec4> whole(16, 16), small(8, 8), empty;
  const std::vector<ColorTarget> colors{rgba32f_target(whole), rgba32f_target(small)};
  EXPECT_NE(failure_of([&] { Pass(16, 16, colors, {}); }), "");
  EXPECT_NE(failure_of([&] { Pass(16, 16, rgba32f_target(empty), {}); }), "");
  const auto identity = [](const auto& color) { return color; };
  Pass pass(16, 16, rgba32f_target(whole), {});
  Image<glm::u8vec4> codes(16, 8);
  EXPECT_NE(failure_of([&] { pass.post(identity, srgb8a8_target(codes)); }).find("(8 vs 16)"), std::string::npos);
  EXPECT_NE(failure_of([&] { pass.post(identity, {.format = ColorFormat::rgba8}); }), "");
  EXPECT_NE(failure_of([&] { pass.post(identity, {}); }), "");
  Image<float> depth(16, 16);
  Image<uint32_t> words(16, 16);
  for (const TexelFormat format : {TexelFormat::rgb9_e5, TexelFormat::d24, TexelFormat::r32ui, TexelFormat::rgba8i})
    EXPECT_NE(failure_of([&] { pass.post(identity, color_target(format, words)); }).find("cannot store colors"), std::string::npos);
  Pass of_integers(16, 16, r32ui_target(words), {});
  EXPECT_NE(failure_of([&] { of_integers.post(identity, r32f_target(depth)); }).find("integers"), std::string::npos);
  // Attachments without an image have no size.
  Pass(640, 480, {.format = ColorFormat::rgba32f, .store = StoreOp::dont_care}, {.format = DepthFormat::d32f});
}

TEST_F(MisuseTest, NumbersThatAreNotInRangeAreRefused) {
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  const auto message = [&](const DrawState& state) {
    return failure_of([&] { pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)), state); });
  };
  for (const float width : {kNaN, -1.0f, 4097.0f, kInfinity, -kInfinity})
    EXPECT_NE(message({.topology = Topology::lines, .line_width = width}), "") << width;
  for (const float size : {kNaN, -1.0f, -kInfinity}) EXPECT_NE(message({.topology = Topology::points, .point_size = size}), "") << size;
  for (const uint32_t query : {4000000000u, 0xffffffffu, kMaxQueries}) EXPECT_NE(message({.query = query}), "") << query;
  for (const DepthOffset& offset : {DepthOffset{.slope = kNaN}, DepthOffset{.constant = kNaN}, DepthOffset{.clamp = kNaN},
                                    DepthOffset{.slope = kInfinity}, DepthOffset{.constant = -kInfinity}})
    EXPECT_NE(message({.offset = offset}), "");
  EXPECT_NE(message({.depth = {.range_near = kNaN}}), "");
  EXPECT_EQ(pass.run(one_worker()).primitives_in, 0u) << "a refused draw is not recorded";
  EXPECT_EQ(message({.topology = Topology::lines, .line_width = kMaxLineWidth}), "");
  EXPECT_EQ(message({.topology = Topology::points, .point_size = 1e6f}), "");
  EXPECT_EQ(message({.query = kMaxQueries - 1}), "");
  EXPECT_EQ(pass.run(one_worker()).queries.size(), kMaxQueries);
}

TEST_F(MisuseTest, ClearsAreChecked) {
  Image<glm::vec4> image(16, 16);
  Image<float> depth(16, 16);
  Pass pass(16, 16, rgba32f_target(image), d32f_target(depth));
  const auto message = [&](const ClearValues& values) { return failure_of([&] { pass.clear(values); }); };
  EXPECT_EQ(message({.rect = Rect{-5, 3, 0, 4}, .colors = {glm::vec4(1)}, .depth = 1.0f}), "");
  for (const float z : {kNaN, -0.5f, 1.5f})
    EXPECT_NE(message({.depth = z}).find("Pass::clear: the depth"), std::string::npos) << message({.depth = z});
  for (const Rect& r : {Rect{0, 0, -1, 4}, Rect{0, 0, 4, -20000}}) EXPECT_NE(message({.rect = r}).find("is negative"), std::string::npos);
  EXPECT_NE(message({.colors = {std::nullopt, glm::vec4(1)}}).find("does not have"), std::string::npos);
  EXPECT_NE(message({.stencil = uint8_t{1}}).find("no stencil"), std::string::npos);
  Pass of_colors(16, 16, rgba32f_target(image), {});
  EXPECT_NE(failure_of([&] { of_colors.clear({.depth = 1.0f}); }).find("no depth target"), std::string::npos);
}

constexpr int kIntMax = std::numeric_limits<int>::max(), kIntMin = std::numeric_limits<int>::min();

// OpenGL has no largest scissor, and programs without a scissor test set one that is larger than every window.
TEST_F(MisuseTest, AScissorCanHaveAnySize) {
  Image<glm::vec4> image(16, 16);
  const auto pixels_drawn = [&](const Rect& scissor, bool clears) {
    Pass pass(16, 16, rgba32f_target(image), {});
    if (clears) {
      pass.clear({.rect = scissor, .colors = {glm::vec4(1)}});
    } else {
      pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)), {.scissor = scissor});
    }
    pass.run(one_worker());
    return std::count(image.data(), image.data() + 256, glm::vec4(1));
  };
  for (const bool clears : {false, true}) {
    EXPECT_EQ(pixels_drawn({0, 0, kIntMax, kIntMax}, clears), 256);
    EXPECT_EQ(pixels_drawn({8, 12, kIntMax, kIntMax}, clears), 32);
    EXPECT_EQ(pixels_drawn({-20000, -20000, 20004, 20016}, clears), 64);
    EXPECT_EQ(pixels_drawn({kIntMin, kIntMin, kIntMax, kIntMax}, clears), 0);
    EXPECT_EQ(pixels_drawn({kIntMax, kIntMax, kIntMax, kIntMax}, clears), 0);
    EXPECT_EQ(pixels_drawn({20000, 0, 16, 16}, clears), 0);
  }
}
static_assert(intersect({kIntMin, 0, kIntMax, 4}, {kIntMax, 2, kIntMax, 4}) == Rect{kIntMax, 2, 0, 2});

// State without effect that OpenGL has no counterpart for.
TEST_F(MisuseTest, StateThatHasNoEffectIsRefused) {
  Image<glm::vec4> image(16, 16);
  Image<float> depth(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  const auto message = [&](const DrawState& state) {
    return failure_of([&] { pass.draw(ConstantShader{}, make_vertex_view(stream(positions_)), state); });
  };
  DrawState state;
  state.attachments[0] = AttachmentState{};
  EXPECT_EQ(message(state), "");
  state.attachments[1] = AttachmentState{};
  EXPECT_NE(message(state).find("does not have"), std::string::npos);

  const auto target_message = [&](auto target) {
    target.store = StoreOp::dont_care;
    return failure_of([&] {
      if constexpr (std::is_same_v<decltype(target), ColorTarget>) {
        Pass(16, 16, target, {});
      } else {
        Pass(16, 16, ColorTarget{}, target);
      }
    });
  };
  EXPECT_NE(target_message(rgba32f_target(image)).find("neither loaded nor stored"), std::string::npos);
  EXPECT_NE(target_message(d32f_target(depth)).find("neither loaded nor stored"), std::string::npos);
  DepthTarget without_stencil = d32f_target(depth);
  without_stencil.stencil_store = StoreOp::store;  // of a format that has none
  EXPECT_NE(target_message(without_stencil).find("neither loaded nor stored"), std::string::npos);
  DepthTarget loaded = d32f_target(depth);
  loaded.load = LoadOp::load;
  EXPECT_EQ(target_message(loaded), "");
}

struct SpriteShader : PositionShader {
  template <class R>
  PointSpriteVertex<R> vertex(const Attributes<R>&, Varyings<R>&) const {
    return {vec2<R>(R(-1)), vec2<R>(R(1)), R(0), MaskOf<R>(true)};
  }
};

TEST_F(MisuseTest, OnlyPointsHaveRectangles) {
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  const auto message = [&](const DrawState& state) {
    return failure_of([&] { pass.draw_depth(SpriteShader{}, make_vertex_view(stream(positions_)), state); });
  };
  EXPECT_EQ(message({.topology = Topology::points}), "");
  EXPECT_EQ(message({.polygon_mode = PolygonMode::point}), "");
  for (const Topology topology : {Topology::triangles, Topology::triangle_fan, Topology::lines, Topology::line_strip})
    EXPECT_NE(message({.topology = topology}).find("expected Topology::points"), std::string::npos);
}

struct PositionAndUv {
  template <class R>
  struct Attributes {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return vec4<R>(in.position, in.uv.x);
  }
};

// The compiler does not know the streams of a plain VertexView.
TEST_F(MisuseTest, StreamsOfPlainViewsAreCompared) {
  const std::vector<float> numbers(15);
  const std::byte* data = std::as_bytes(std::span(numbers)).data();
  Pass pass(16, 16, ColorTarget{}, {.format = DepthFormat::d32f});
  const auto message = [&](std::initializer_list<int32_t> components) {
    std::vector<VertexStream> streams;
    for (const int32_t n : components) streams.push_back({.data = data, .stride = 20, .components = n, .count = 3});
    return failure_of([&] { pass.draw_depth(PositionAndUv{}, detail::bind_streams(streams)); });
  };
  EXPECT_EQ(message({3, 2}), "");
  EXPECT_EQ(message({5}), "") << "interleaved";
  for (const auto& other : {std::initializer_list<int32_t>{2, 3}, {4, 1}, {1, 2, 2}, {3}, {3, 1}, {3, 2, 1}, {6}})
    EXPECT_NE(message(other).find("do not match the attributes"), std::string::npos) << other.size();
}

TEST_F(MisuseTest, StreamsMadeByHandAreChecked) {
  const std::array<float, 4> numbers{};
  const std::byte* data = std::as_bytes(std::span(numbers)).data();
  const auto message = [](const VertexStream& s) { return failure_of([&] { make_vertex_view(s); }); };
  EXPECT_EQ(message({.data = data, .stride = 0, .components = 1, .count = 9}), "");
  EXPECT_NE(message({.data = nullptr, .stride = 4, .components = 1, .count = 9}), "");
  EXPECT_NE(message({.data = data, .stride = -1, .components = 1, .count = 9}), "");
  EXPECT_NE(message({.data = data, .stride = 16, .components = 4, .count = std::size_t{1} << 62}), "") << "the product overflows";
  EXPECT_NE(message({.data = data, .stride = 0, .components = -1, .count = 9}), "");
  EXPECT_NE(message({.data = data, .stride = 0, .components = 65, .count = 9}), "");
  EXPECT_NE(message({.data = data, .components = 3, .count = 9, .type = ComponentType::int_2_10_10_10}), "") << "four are packed";
  EXPECT_NE(message({.data = data, .components = 4, .count = 9, .type = ComponentType::int_2_10_10_10, .read_as = ReadAs::integers}), "");
  for (const ComponentType type : {ComponentType::float32, ComponentType::float16, ComponentType::float64}) {
    EXPECT_EQ(message({.data = data, .components = 1, .count = 9, .type = type}), "");
    EXPECT_NE(message({.data = data, .components = 1, .count = 9, .type = type, .read_as = ReadAs::normalized}), "");
    EXPECT_NE(message({.data = data, .components = 1, .count = 9, .type = type, .read_as = ReadAs::integers}), "");
    const std::string halves = message({.data = data, .components = 1, .count = 9, .type = type, .read_as = ReadAs::halves});
    EXPECT_EQ(halves == "", type == ComponentType::float16) << halves;
  }
  for (const ComponentType type : {ComponentType::uint8, ComponentType::uint16, ComponentType::int32})
    EXPECT_NE(message({.data = data, .components = 1, .count = 9, .type = type, .read_as = ReadAs::halves}), "");
}

TEST_F(MisuseTest, TheNaivePipelineChecksIndicesAndSizes) {
  const std::vector<uint32_t> list{0, 1, 5};
  const Indices of_six(list, 6), in_order = Indices::sequential(3);
  const std::vector<float> numbers(3);
  NaiveTarget<float> target(16, 16, vec4<float>(0.0f), 1.0f);
  const auto draw = [&](const VertexView& view, const Indices& indices) {
    return failure_of([&] { draw_naive(target, ConstantShader{}, view, indices); });
  };
  EXPECT_EQ(draw(make_vertex_view(stream(positions_)), in_order), "");
  EXPECT_NE(draw(make_vertex_view(stream(positions_)), of_six), "");
  EXPECT_NE(draw(make_vertex_view(stream(numbers)), in_order), "") << "one float per vertex instead of four";
  const std::vector<uint32_t> ended{0, 1, 2, 0xffffffff};
  EXPECT_NE(draw(make_vertex_view(stream(positions_)), Indices(ended, 3, PrimitiveRestart::on)).find("restarts"), std::string::npos);
  EXPECT_NE(draw(make_vertex_view(3, per_instance(stream(positions_))), in_order).find("one row per instance"), std::string::npos);
  target.depth = Image<float>(8, 8);
  EXPECT_NE(draw(make_vertex_view(stream(positions_)), in_order), "");
}

}  // namespace
}  // namespace halfspace::raster_test
