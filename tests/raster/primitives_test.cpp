// SPDX-License-Identifier: Apache-2.0
//
// Tests strips, fans, primitive restart, base vertex and instancing with hand-computed values.
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

glm::vec4 red_at(float red) { return {red, 0.0f, 0.0f, 1.0f}; }

// Vertices of a strip across a 32x16 px picture: a zigzag of columns 8 px wide that starts at the bottom.
std::vector<glm::vec4> zigzag() {
  std::vector<glm::vec4> p;
  for (int i = 0; i < 10; ++i) p.push_back(clip_position({256 * 8 * (i / 2), i % 2 == 0 ? 0 : 256 * 16}, 32, 16));
  return p;
}

struct Drawing {
  Image<glm::vec4> image{32, 16};
  PassStatistics statistics;
};

template <class... Streams>
Drawing draw_strip(const Indices& indices, DrawState state, const Streams&... streams) {
  Drawing d;
  Pass pass(32, 16, rgba32f_target(d.image), {});
  pass.draw(FlatColorShader{}, make_vertex_view(streams...), indices, state);
  d.statistics = pass.run(one_worker());
  return d;
}

std::vector<glm::vec4> numbered(std::size_t n) {
  std::vector<glm::vec4> c;
  for (std::size_t i = 0; i < n; ++i) c.push_back(red_at(static_cast<float>(i)));
  return c;
}

TEST(Primitives, AStripCoversEveryPixelOnceWithOneFacing) {
  const std::vector<glm::vec4> p = zigzag();
  std::vector<uint32_t> list(p.size());
  for (uint32_t i = 0; i < list.size(); ++i) list[i] = i;
  Image<glm::vec4> image(32, 16);
  // Bottom, top, next bottom: clockwise.
  const PassStatistics s =
      count_coverage(image, p, list, {.topology = Topology::triangle_strip, .cull = CullMode::back, .front = Winding::clockwise});
  EXPECT_EQ(s.primitives_in, 8u);
  EXPECT_EQ(s.culled_face, 0u);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) EXPECT_EQ(pixel(image, x, y).x, 1.0f) << x << ' ' << y;
  }
}

// OpenGL 4.6, table 13.2, counted from 0: the provoking vertex of triangle i of a strip is i under the first-vertex convention and i + 2
// otherwise. For a fan it is i + 1 and i + 2.
TEST(Primitives, ProvokingVerticesFollowOpenGl) {
  const std::vector<glm::vec4> p = zigzag(), c = numbered(p.size());
  const Indices all = Indices::sequential(p.size());
  const Drawing first = draw_strip(all, {.topology = Topology::triangle_strip, .provoking = ProvokingVertex::first}, stream(p), stream(c));
  const Drawing last = draw_strip(all, {.topology = Topology::triangle_strip}, stream(p), stream(c));
  for (int column = 0; column < 4; ++column) {  // lower left: even triangle; upper right: odd triangle
    const int even = 2 * column, x = 8 * column;
    EXPECT_EQ(pixel(first.image, x, 1).x, static_cast<float>(even));
    EXPECT_EQ(pixel(first.image, x + 7, 14).x, static_cast<float>(even + 1));
    EXPECT_EQ(pixel(last.image, x, 1).x, static_cast<float>(even + 2));
    EXPECT_EQ(pixel(last.image, x + 7, 14).x, static_cast<float>(even + 3));
  }
  std::vector<glm::vec4> square;
  for (const Point corner : {Point{0, 0}, Point{32 * 256, 0}, Point{32 * 256, 16 * 256}, Point{0, 16 * 256}}) {
    square.push_back(clip_position(corner, 32, 16));
  }
  const Indices four = Indices::sequential(4);
  const std::vector<glm::vec4> colors = numbered(4);
  const Drawing fan_first =
      draw_strip(four, {.topology = Topology::triangle_fan, .provoking = ProvokingVertex::first}, stream(square), stream(colors));
  const Drawing fan_last = draw_strip(four, {.topology = Topology::triangle_fan}, stream(square), stream(colors));
  EXPECT_EQ(pixel(fan_first.image, 30, 1).x, 1.0f);
  EXPECT_EQ(pixel(fan_first.image, 1, 14).x, 2.0f);
  EXPECT_EQ(pixel(fan_last.image, 30, 1).x, 2.0f);
  EXPECT_EQ(pixel(fan_last.image, 1, 14).x, 3.0f);
}

TEST(Primitives, RestartBeginsANewStripWithoutAConnectingTriangle) {
  const std::vector<glm::vec4> p = zigzag(), c = numbered(p.size());
  const std::vector<uint32_t> list{0xffffffffu, 0, 1, 2, 3, 0xffffffffu, 0xffffffffu, 6, 7, 0xffffffffu, 6, 7, 8, 9};
  const Drawing d =
      draw_strip(Indices(std::span(list), p.size(), PrimitiveRestart::on), {.topology = Topology::triangle_strip}, stream(p), stream(c));
  EXPECT_EQ(d.statistics.primitives_in, 4u);
  EXPECT_EQ(d.statistics.vertices_shaded, 8u);
  EXPECT_EQ(d.statistics.vertices_in, 10u);
  for (int x = 0; x < 32; ++x) EXPECT_EQ(pixel(d.image, x, 8).w, x < 8 || x >= 24 ? 1.0f : 0.0f) << x;
  const std::vector<uint16_t> narrow{0, 1, 2, 0xffff, 2, 1, 3};  // restart also works for lists
  const Drawing e = draw_strip(Indices(std::span(narrow), p.size(), PrimitiveRestart::on), {}, stream(p), stream(c));
  EXPECT_EQ(e.statistics.primitives_in, 2u);
}

TEST(Primitives, BaseVertexIsAddedToEveryIndex) {
  const std::vector<glm::vec4> p = zigzag(), c = numbered(p.size());
  const std::vector<uint32_t> list{0, 1, 2, 3};
  const Indices indices(list, p.size());
  const Drawing d = draw_strip(indices, {.topology = Topology::triangle_strip, .base_vertex = 4}, stream(p), stream(c));
  for (int x = 0; x < 32; ++x) EXPECT_EQ(pixel(d.image, x, 8).w, x >= 16 && x < 24 ? 1.0f : 0.0f) << x;
  EXPECT_EQ(pixel(d.image, 16, 1).x, 6.0f);  // triangle 4, 5, 6: the last vertex is provoking
}

// Every instance draws one column, shifted by the instance number. Every second instance reads a new color.
struct ColumnShader : FlatColorShader {
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color.value = vec4<R>(in.color.x, to_real<R>(id.vertex), R(static_cast<float>(id.instance)), R(1.0f));
    vec4<R> p = in.position;
    p.x = p.x + R(0.5f * static_cast<float>(id.instance));
    return p;
  }
};

TEST(Primitives, InstancesHaveTheirNumberAndReadTheirData) {
  const std::vector<glm::vec4> p = zigzag(), c{red_at(10.0f), red_at(20.0f)};
  const std::vector<uint32_t> list{0, 1, 2, 3};
  const Indices indices(list, p.size());
  for (const uint32_t chunk : {1u, 3u, 8192u}) {
    Image<glm::vec4> image(32, 16);
    Pass pass(32, 16, rgba32f_target(image), {}, {.tuning = {.chunk_triangles = chunk}});
    pass.draw(ColumnShader{}, make_vertex_view(stream(p), per_instance(stream(c), 2)), indices,
              {.topology = Topology::triangle_strip, .instances = 4});
    EXPECT_EQ(pass.run(one_worker()).vertices_shaded, 16u);
    for (int x = 0; x < 32; ++x) {
      const int instance = x / 8;
      EXPECT_EQ(pixel(image, x, 1).x, instance < 2 ? 10.0f : 20.0f) << x;
      EXPECT_EQ(pixel(image, x, 15).y, 3.0f) << x;
      EXPECT_EQ(pixel(image, x, 1).z, static_cast<float>(instance)) << x;
    }
  }
}

// A triangle that covers the viewport, made of the vertex number alone.
struct NoAttributesShader {
  template <class R>
  struct Attributes {};
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>&, const VertexId<R>& id, Varyings<R>&) const {
    return {select(id.vertex == IntOf<R>(1), R(3.0f), R(-1.0f)), select(id.vertex == IntOf<R>(2), R(3.0f), R(-1.0f)), R(0.0f), R(1.0f)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(0.25f), R(0.5f), R(0.75f), R(1.0f))};
  }
};

TEST(Primitives, DrawsNeedNoStreams) {
  Image<glm::vec4> image(20, 10);
  Pass pass(20, 10, rgba32f_target(image), {});
  const Indices indices = Indices::sequential(3);
  pass.draw(NoAttributesShader{}, make_vertex_view(3), indices);
  EXPECT_EQ(pass.run(one_worker()).vertices_shaded, 3u);
  for (const glm::vec4& color : image.texels()) ASSERT_EQ(color, glm::vec4(0.25f, 0.5f, 0.75f, 1.0f));
}

}  // namespace

}  // namespace halfspace
