// SPDX-License-Identifier: Apache-2.0
//
// Tests layered targets and arrays of viewports. A layer must be the picture of a pass of its own, and a viewport that of a draw of its
// own.
#include "halfspace/shading/texture/texture_memory.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test::layered_test {
namespace {

constexpr int kWidth = 40, kHeight = 24;

// Draws each triangle into each of kLayers layers, moved and in other colors, or into viewports.
template <bool kViewports>
struct EveryLayer : SmoothColorShader {
  static constexpr GeometryLayout geometry_layout{.max_vertices = 3, .invocations = 6};
  template <class R>
  using EmittedVertex = LayeredVertex<R>;

  template <class R>
  static vec4<R> moved(const vec4<R>& p, int layer) {
    const R shift(0.0625f * static_cast<float>(layer));
    return vec4<R>(p.x + shift * p.w, p.y - shift * p.w, p.z, p.w);
  }
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>, LayeredVertex<R>>& out) const {
    const int32_t number = in.invocation - 1;  // −1 and those from the number of layers on are not drawn
    for (std::size_t i = 0; i < 3; ++i) {
      // Only the provoking vertex, the last one, determines the layer.
      const IntOf<R> chosen(i == 2 ? number : 3 - number);
      LayeredVertex<R> v{.position = moved(in.position[i], number)};
      (kViewports ? v.viewport : v.layer) = chosen;
      out.emit(v, in.varyings[i]);
    }
  }
};

// The same with an instance per layer: the vertex function chooses the layer or the viewport.
template <bool kViewports>
struct EveryInstance : SmoothColorShader {
  template <class R>
  LayeredVertex<R, 1, 1> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color = in.color;
    const int32_t number = id.instance - 1;
    LayeredVertex<R, 1, 1> v{.position = EveryLayer<false>::moved(in.position, number),
                             .clip_distance = {R(1)},
                             .cull_distance = {select(id.vertex < IntOf<R>(57), R(1), R(-1))}};  // not the last triangle
    const auto corner = id.vertex - ((id.vertex * IntOf<R>(21846)) >> 16) * IntOf<R>(3);
    (kViewports ? v.viewport : v.layer) = select(corner == IntOf<R>(2), IntOf<R>(number), IntOf<R>(3 - number));
    return v;
  }
};

// All vertices of an instance are in one layer. The color shows the numbers of the primitive and the instance.
struct WholeInstances : SmoothColorShader {
  std::array<int32_t, 12> numbers{};  // of the instances
  template <class R>
  LayeredVertex<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color = in.color;
    return {EveryLayer<false>::moved(in.position, id.instance), IntOf<R>(numbers[static_cast<std::size_t>(id.instance)])};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const PrimitiveId<R>& id, const Pixel<R>&) const {
    return {vec4<R>(to_real<R>(id.primitive), to_real<R>(id.instance), in.color.x, id.barycentrics.y)};
  }
};
// One instance of it.
struct OneInstance : WholeInstances {
  int32_t instance = 0;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return EveryLayer<false>::moved(in.position, instance);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const PrimitiveId<R>& id, const Pixel<R>& px) const {
    Fragment<R> f = WholeInstances::fragment<R>(in, id, px);
    f.color.y = R(static_cast<float>(instance));
    return f;
  }
};

struct Moved : SmoothColorShader {
  int layer = 0;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return EveryLayer<false>::moved(in.position, layer);
  }
};

struct Vertices {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

Vertices random_vertices(uint64_t seed, int count) {
  Random random(seed);
  Vertices v;
  for (int i = 0; i < count; ++i) {
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    v.positions.push_back({number(-1.5, 1.5), number(-1.5, 1.5), number(-0.9, 0.9), number(0.5, 2)});
    v.colors.push_back({number(0, 1), number(0, 1), number(0, 1), 1.0f});
  }
  return v;
}

TEST(Layers, EachIsThePictureOfAPassOfItsOwn) {
  constexpr int kLayers = 4;
  constexpr PassTuning kManyFlushes{.tile_size = 8, .chunk_triangles = 1, .bin_budget = 1}, kImmediate{.defer = false};
  using Options = std::tuple<int, PassTuning, bool>;
  for (const auto& [samples, tuning, by_vertex] : {Options(1, {}, false),
                                                   {4, {}, false},
                                                   {1, kManyFlushes, false},
                                                   {4, kManyFlushes, true},
                                                   {1, kImmediate, false},
                                                   {1, {}, true},
                                                   {4, kImmediate, true}}) {
    const Vertices v = random_vertices(31, 60), flat = random_vertices(32, 9);
    std::vector<glm::vec4> colors(std::size_t{kWidth} * kHeight * kLayers);
    std::vector<float> depths(colors.size());
    const auto view_of = [&](auto& values, TexelFormat format) {
      const auto pixel = static_cast<std::ptrdiff_t>(sizeof(values[0]));
      return TexelView{
          format, reinterpret_cast<std::byte*>(values.data()), kWidth, kHeight, kLayers, pixel * kWidth, pixel * kWidth * kHeight};
    };
    const TexelView color_view = view_of(colors, TexelFormat::rgba32f), depth_view = view_of(depths, TexelFormat::d32f);
    ColorTarget target = layered_color_target(color_view);
    target.clear_value = glm::vec4(0.25f);
    Pass pass(kWidth, kHeight, target, layered_depth_target(depth_view), {.samples = samples, .layers = kLayers, .tuning = tuning});
    pass.draw(FlatColorShader{}, flat.view());                                              // without a layer: drawn into layer 0
    pass.clear({.rect = Rect{3, 4, 10, 12}, .colors = {glm::vec4(0.75f)}, .depth = 0.5f});  // in all layers
    if (by_vertex) {
      pass.draw(EveryInstance<false>{}, v.view(), {.instances = 6, .query = 2});
    } else {
      pass.draw(EveryLayer<false>{}, v.view(), {.query = 2});
    }
    const PassStatistics s = pass.run(two_workers());
    EXPECT_EQ(s.geometry_invocations, by_vertex ? 0u : 20u * 6u);
    EXPECT_EQ(s.query_primitives, (std::vector<uint64_t>{0, 0, 20 * kLayers}));
    for (int layer = 0; layer < kLayers; ++layer) {
      std::vector<glm::vec4> color(std::size_t{kWidth} * kHeight);
      std::vector<float> depth(color.size());
      ColorTarget own = color_target(TexelView{TexelFormat::rgba32f, reinterpret_cast<std::byte*>(color.data()), kWidth, kHeight, 1,
                                               kWidth * static_cast<std::ptrdiff_t>(sizeof(glm::vec4)), 0});
      own.clear_value = target.clear_value;
      Pass single(kWidth, kHeight, own,
                  depth_target(TexelView{TexelFormat::d32f, reinterpret_cast<std::byte*>(depth.data()), kWidth, kHeight, 1,
                                         kWidth * static_cast<std::ptrdiff_t>(sizeof(float)), 0}),
                  {.samples = samples});
      if (layer == 0) single.draw(FlatColorShader{}, flat.view());
      single.clear({.rect = Rect{3, 4, 10, 12}, .colors = {glm::vec4(0.75f)}, .depth = 0.5f});
      single.draw(Moved{{}, layer}, v.view(), {.count = by_vertex ? 57u : 60u});  // a cull distance removes the last triangle
      single.run(one_worker());
      const auto begin = static_cast<std::ptrdiff_t>(color.size()) * layer;
      EXPECT_TRUE(std::equal(color.begin(), color.end(), colors.begin() + begin)) << layer;
      EXPECT_TRUE(std::equal(depth.begin(), depth.end(), depths.begin() + begin)) << layer;
    }
  }
}

// With strips, vertices that are not used, restarts, and instances that are not drawn.
TEST(Layers, WholeInstancesAreDrawsOfTheirOwn) {
  constexpr int kLayers = 3;
  const std::array<int32_t, 12> numbers{0, 0, 2, -1, 2, 1, 1, 3, 0, 2, 2, 1};
  const Vertices v = random_vertices(37, 200);
  std::vector<uint16_t> indices;
  for (std::size_t i = 0; i < 300; ++i) indices.push_back(i % 50 == 49 ? 0xffff : static_cast<uint16_t>(3 + (i * 7) % 150));
  const Indices list(indices, v.positions.size(), PrimitiveRestart::on);
  DrawState state{.topology = Topology::triangle_strip, .instances = 12};
  WholeInstances shader;
  shader.numbers = numbers;
  std::vector<glm::vec4> colors(std::size_t{kWidth} * kHeight * kLayers);
  constexpr auto kPixel = static_cast<std::ptrdiff_t>(sizeof(glm::vec4));
  const auto target = [&](auto* data, int layers) {
    return TexelView{TexelFormat::rgba32f, reinterpret_cast<std::byte*>(data), kWidth, kHeight, layers,
                     kPixel * kWidth,      kPixel * kWidth * kHeight};
  };
  Pass pass(kWidth, kHeight, layered_color_target(target(colors.data(), kLayers)), {}, {.layers = kLayers});
  pass.draw(shader, v.view(), list, state);
  const PassStatistics s = pass.run(two_workers());
  EXPECT_EQ(s.vertices_in, 12u * (300 - 6));
  state.instances = 1;
  for (int layer = 0; layer < kLayers; ++layer) {
    std::vector<glm::vec4> expected(std::size_t{kWidth} * kHeight);
    Pass single(kWidth, kHeight, color_target(target(expected.data(), 1)), {});
    for (int i = 0; i < 12; ++i) {
      OneInstance one;
      one.instance = i;
      if (numbers[static_cast<std::size_t>(i)] == layer) single.draw(one, v.view(), list, state);
    }
    single.run(one_worker());
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), colors.begin() + static_cast<std::ptrdiff_t>(expected.size()) * layer))
        << layer;
  }
}

// As in OpenGL, the layer has no effect if the targets have none.
TEST(Layers, HaveNoEffectInAPassWithOneLayer) {
  const Vertices v = random_vertices(35, 9);
  Image<glm::vec4> color(kWidth, kHeight), expected(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(color), {}), plain(kWidth, kHeight, rgba32f_target(expected), {});
  pass.draw(EveryLayer<false>{}, v.view());
  pass.run(one_worker());
  for (uint32_t triangle = 0; triangle < 3; ++triangle) {
    for (int layer = -1; layer < 5; ++layer) plain.draw(Moved{{}, layer}, v.view(), {.first = 3 * triangle, .count = 3});
  }
  plain.run(one_worker());
  EXPECT_EQ(color, expected);
}

// A draw that emits nothing, or only into viewports that do not exist, has a query like any other.
TEST(Layers, QueriesOfDrawsWithoutPrimitivesAreZero) {
  const Vertices v = random_vertices(36, 3);
  Image<glm::vec4> color(kWidth, kHeight);
  const ViewportArray one{{}};
  Pass pass(kWidth, kHeight, rgba32f_target(color), {});
  pass.draw(EveryLayer<true>{}, v.view(), {.count = 0u, .viewports = &one, .query = 3});
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s.queries, (std::vector<uint64_t>(4, 0)));
  EXPECT_EQ(s.query_primitives, (std::vector<uint64_t>(4, 0)));
  pass.draw(EveryLayer<true>{}, v.view(), {.viewports = &one, .query = 1});
  const PassStatistics t = pass.run(one_worker());
  EXPECT_EQ(t.query_primitives, (std::vector<uint64_t>{0, 1}));  // one of six invocations chooses viewport 0
}

// Two viewports that overlap, one with a scissor and another depth range, and one that is not drawn to.
TEST(Layers, ViewportsAreThoseOfDrawsOfTheirOwn) {
  const Vertices v = random_vertices(33, 30);
  for (const bool overlap : {false, true}) {
    const ViewportArray viewports{
        {.viewport = Rect{0, 0, 20, 24}},
        {.viewport = Rect{overlap ? 10 : 20, 2, 20, 20}, .scissor = Rect{12, 5, 25, 9}, .range_near = 0.5f, .range_far = 1.0f},
        {.viewport = Rect{0, 0, 1, 1}, .scissor = Rect{0, 0, 0, 0}}};
    Image<glm::vec4> color(kWidth, kHeight), expected(kWidth, kHeight);
    Image<float> depth(kWidth, kHeight), expected_depth(kWidth, kHeight);
    // Without a depth test, the order of triangles in overlapping viewports is visible.
    for (const bool tested : {false, true}) {
      Pass pass(kWidth, kHeight, rgba32f_target(color), d32f_target(depth));
      const DrawState state{.viewports = &viewports, .depth = {.test = tested}};
      pass.draw(EveryLayer<true>{}, v.view(), state);
      pass.run(one_worker());
      Pass single(kWidth, kHeight, rgba32f_target(expected), d32f_target(expected_depth));
      for (uint32_t triangle = 0; triangle < 10; ++triangle) {
        for (int i = 0; i < 2; ++i) {
          const IndexedViewport& of = viewports[static_cast<std::size_t>(i)];
          single.draw(Moved{{}, i}, v.view(),
                      {.first = 3 * triangle,
                       .count = 3,
                       .viewport = of.viewport,
                       .scissor = of.scissor,
                       .depth = {.test = tested, .range_near = of.range_near, .range_far = of.range_far}});
        }
      }
      single.run(one_worker());
      EXPECT_EQ(color, expected);
      EXPECT_EQ(depth, expected_depth);
    }
  }
}

// The faces of a cube map in one pass. Six invocations draw into layers −1 to 4.
TEST(Layers, FacesOfACubeMapAreLayers) {
  TextureMemory memory(TextureKind::cube, TexelFormat::r32f, {16, 16, 6});
  Pass pass(16, 16, layered_color_target(memory.level()), {}, {.layers = 6});
  const std::vector<glm::vec4> positions = full_screen(), colors(3, glm::vec4(0.5f));
  pass.draw(EveryLayer<false>{}, make_vertex_view(stream(positions), stream(colors)));
  pass.run(one_worker());
  for (int face = 0; face < 6; ++face) {
    const auto* const texel = reinterpret_cast<const float*>(memory.level().at(8, 8, face));
    EXPECT_EQ(*texel, face < 5 ? 0.5f : 0.0f) << face;
  }
}

TEST(LayersDeathTest, ViewportsNeedAShaderThatChoosesThem) {
  const ViewportArray viewports{{.viewport = Rect{0, 0, 8, 8}}}, none, empty{{.viewport = Rect{0, 0, 0, 8}}}, far{{.range_far = 1.5f}};
  const Vertices v = random_vertices(34, 3);
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  EXPECT_DEATH(pass.draw(SmoothColorShader{}, v.view(), {.viewports = &viewports}), "does not choose among them");
  EXPECT_DEATH(pass.draw(EveryLayer<true>{}, v.view(), {.viewports = &none}), "number of viewports is outside of its range");
  EXPECT_DEATH(pass.draw(EveryLayer<true>{}, v.view(), {.viewports = &empty}), "size of the viewport is outside of its range");
  EXPECT_DEATH(pass.draw(EveryLayer<true>{}, v.view(), {.viewports = &far}), "depth range is outside of its range");
}

TEST(LayersDeathTest, TargetsNeedTheLayersOfThePass) {
  std::vector<float> values(4 * 4 * 3);
  const TexelView view{TexelFormat::r32f, reinterpret_cast<std::byte*>(values.data()), 4, 4, 3, 16, 64};
  EXPECT_DEATH(Pass(4, 4, layered_color_target(view), {}), "another number of layers than the pass");
  EXPECT_DEATH(Pass(4, 4, layered_color_target(view), {}, {.layers = 2}), "another number of layers than the pass");
  EXPECT_DEATH(Pass(4, 4, layered_color_target(view), {}, {.layers = 0}), "number of layers is outside of its range");
  ColorTarget overlapping = layered_color_target(view);
  overlapping.layer_pitch = 32;
  EXPECT_DEATH(Pass(4, 4, overlapping, {}, {.layers = 3}), "samples or layers overlap");
  ColorTarget stored = layered_color_target(view);
  stored.samples = 4;
  EXPECT_DEATH(Pass(4, 4, stored, {}, {.samples = 4, .layers = 3}), "layers and stored samples");
  Pass pass(4, 4, layered_color_target(view), {}, {.layers = 3});
  Image<float> after(4, 4);
  EXPECT_DEATH(pass.post([]<class R>(const vec4<R>& c) { return c; }, r32f_target(after)), "the pass has several layers");
}

}  // namespace
}  // namespace halfspace::raster_test::layered_test
