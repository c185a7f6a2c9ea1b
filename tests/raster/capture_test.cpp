// SPDX-License-Identifier: Apache-2.0
//
// Tests capture(): the vertices that it returns, and that a draw of them is the draw they come from.
#include "halfspace/raster/capture.h"

#include "raster/raster_test.h"

namespace halfspace::raster_test::capture_test {
namespace {

// Positions and colors that depend on the vertex and the instance.
struct MovedShader {
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<IntOf<R>> vertex;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color = vec3<R>(in.color) * R(0.5f);
    out.vertex.value = id.vertex;
    return vec4<R>(in.position.x + R(0.125f * static_cast<float>(id.instance)), in.position.y, in.position.z, in.position.w);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color, to_real<R>(in.vertex.value))};
  }
};
using Moved = MovedShader::Varyings<float>;

// The same with a layer, which a capture does not contain.
struct LayeredShader : MovedShader {
  template <class R>
  LayeredVertex<R, 1> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    return {.position = MovedShader::vertex(in, id, out), .layer = id.vertex, .clip_distance = {R(1)}};
  }
};

// Draws what was captured of MovedShader.
struct CapturedShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> color;
    IntOf<R> vertex;
  };
  template <class R>
  using Varyings = MovedShader::Varyings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    out.vertex.value = in.vertex;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return MovedShader{}.fragment(in, px);
  }
};

struct Vertices {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

Vertices random_vertices(Random& random, std::size_t count) {
  Vertices v;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&] { return static_cast<float>(random.real(-2.0, 2.0)); };
    v.positions.push_back({number(), number(), number(), number() + 1.5f});
    v.colors.push_back({number(), number(), number(), 1.0f});
  }
  return v;
}

std::vector<int> vertices_of(const CapturedVertices<Moved>& c) {
  std::vector<int> out;
  for (const Moved& v : c.varyings) out.push_back(v.vertex.value);
  return out;
}

TEST(Capture, ReturnsPositionsAndVaryingsOfTheVertexFunction) {
  Random random(3);
  const Vertices v = random_vertices(random, 700);
  const CapturedVertices<Moved> c = capture(MovedShader{}, v.view(), two_workers());
  EXPECT_EQ(c.topology, Topology::triangles);
  EXPECT_EQ(c.primitives, 233u);
  ASSERT_EQ(c.positions.size(), 699u);
  for (std::size_t i = 0; i < 699; ++i) {
    EXPECT_EQ(c.positions[i], v.positions[i]);
    EXPECT_EQ(glm::vec3(c.varyings[i].color.x, c.varyings[i].color.y, c.varyings[i].color.z), 0.5f * glm::vec3(v.colors[i]));
    EXPECT_EQ(c.varyings[i].vertex.value, static_cast<int>(i));
  }
}

// OpenGL 4.6, section 13.3.2 and table 13.2: strips, loops and fans become lists.
TEST(Capture, LayersHaveNoEffect) {
  Random random(4);
  const Vertices v = random_vertices(random, 30);
  const DrawState state{.instances = 2};
  const auto captured = capture(LayeredShader{}, v.view(), two_workers(), state);
  const auto expected = capture(MovedShader{}, v.view(), one_worker(), state);
  EXPECT_EQ(captured.positions, expected.positions);
  ASSERT_EQ(captured.varyings.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(captured.varyings[i].color, expected.varyings[i].color);
    EXPECT_EQ(captured.varyings[i].vertex.value, expected.varyings[i].vertex.value);
  }
}

TEST(Capture, ResolvesStripsLoopsAndFans) {
  Random random(4);
  const Vertices v = random_vertices(random, 8);
  const auto captured = [&](Topology topology, std::vector<uint32_t> list, ProvokingVertex provoking = ProvokingVertex::last) {
    const Indices indices(list, 8, PrimitiveRestart::on);
    return vertices_of(capture(MovedShader{}, v.view(), indices, one_worker(), {.topology = topology, .provoking = provoking}));
  };
  const std::vector<uint32_t> five{0, 1, 2, 3, 4}, eight{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(captured(Topology::points, {3, 0xffffffffu, 1}), (std::vector{3, 1}));
  EXPECT_EQ(captured(Topology::lines, five), (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(captured(Topology::line_strip, {0, 1, 0xffffffffu, 5, 6, 7}), (std::vector{0, 1, 5, 6, 6, 7}));
  EXPECT_EQ(captured(Topology::line_loop, {0, 1, 2}), (std::vector{0, 1, 1, 2, 2, 0}));
  EXPECT_EQ(captured(Topology::triangle_strip, five), (std::vector{0, 1, 2, 2, 1, 3, 2, 3, 4}));
  EXPECT_EQ(captured(Topology::triangle_strip, five, ProvokingVertex::first), (std::vector{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(captured(Topology::triangle_fan, {0, 1, 2, 3}), (std::vector{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(captured(Topology::lines_adjacency, eight), (std::vector{1, 2, 5, 6}));
  EXPECT_EQ(captured(Topology::triangle_strip_adjacency, eight), (std::vector{0, 2, 4, 4, 2, 6}));
  EXPECT_EQ(captured(Topology::triangles, {}), std::vector<int>{});
}

TEST(Capture, ADrawOfTheResultIsTheDrawItComesFrom) {
  Random random(5);
  for (int i = 0; i < effort(20); ++i) {
    const Vertices v = random_vertices(random, 60);
    std::vector<uint32_t> list;
    for (int k = 0; k < 80; ++k) list.push_back(static_cast<uint32_t>(random.below(60)));
    const DrawState state{.topology = random.pick({Topology::triangles, Topology::triangle_strip, Topology::line_strip, Topology::points}),
                          .instances = random.pick({1u, 3u}),
                          .provoking = random.pick({ProvokingVertex::first, ProvokingVertex::last})};
    const CapturedVertices<Moved> c = capture(MovedShader{}, v.view(), list, one_worker(), state);
    const CapturedVertices<Moved> by_three = capture(MovedShader{}, v.view(), list, Workers(3), state);
    EXPECT_EQ(by_three.positions, c.positions);
    EXPECT_EQ(vertices_of(by_three), vertices_of(c));
    DrawState list_state = state;
    list_state.topology = c.topology;
    list_state.instances = 1;
    Image<glm::vec4> expected(64, 64), image(64, 64);
    Pass plain(64, 64, rgba32f_target(expected), {.format = DepthFormat::d32f});
    plain.draw(MovedShader{}, v.view(), list, state);
    plain.run(one_worker());
    Pass pass(64, 64, rgba32f_target(image), {.format = DepthFormat::d32f});
    const std::vector<int> vertices = vertices_of(c);
    pass.draw(CapturedShader{},
              make_vertex_view(stream(c.positions), stream(c.varyings, &Moved::color), stream<ReadAs::integers>(vertices)), list_state);
    pass.run(one_worker());
    EXPECT_EQ(image, expected);
  }
}

}  // namespace
}  // namespace halfspace::raster_test::capture_test
