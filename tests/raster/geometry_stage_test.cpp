// SPDX-License-Identifier: Apache-2.0
//
// Tests the geometry stage. A draw with it must give the pixels of a draw of the primitives that it emits, which the tests write by hand.
#include <mutex>

#include "raster/raster_test.h"

namespace halfspace::raster_test::geometry_stage_test {
namespace {

constexpr int kWidth = 64, kHeight = 64;

// Hands on the triangles that it receives.
struct SameTriangles : SmoothColorShader {
  static constexpr GeometryLayout geometry_layout{};

  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) out.emit(in.position[i], in.varyings[i]);
  }
};

struct Picture {
  Image<glm::vec4> color{kWidth, kHeight};
  PassStatistics statistics;
};

template <class S, class V, class I>
Picture draw(const S& shader, const V& view, const I& indices, const DrawState& state, int threads = 1, int samples = 1) {
  Picture p;
  Pass pass(kWidth, kHeight, rgba32f_target(p.color), {.format = DepthFormat::d32f}, {.samples = samples});
  pass.draw(shader, view, indices, state);
  p.statistics = pass.run(Workers(threads));
  return p;
}

struct Soup {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

// Random vertices; some are behind the eye or far outside of the view.
Soup random_vertices(Random& random, std::size_t count) {
  Soup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    soup.positions.push_back({number(-2, 2), number(-2, 2), number(-1.5, 1.5), number(-0.2, 2)});
    soup.colors.push_back({number(0, 1), number(0, 1), number(0, 1), 1.0f});
  }
  return soup;
}

TEST(GeometryStage, EmittingTheInputChangesNothing) {
  Random random(7);
  for (int i = 0; i < effort(40); ++i) {
    const Soup soup = random_vertices(random, 60);
    std::vector<uint32_t> list;
    for (int k = 0; k < 90; ++k) list.push_back(random.once_in(9) ? 0xffffffffu : static_cast<uint32_t>(random.below(60)));
    const Indices indices(list, 60, PrimitiveRestart::on);
    DrawState state{.topology = random.pick({Topology::triangles, Topology::triangle_strip, Topology::triangle_fan}),
                    .polygon_mode = random.pick({PolygonMode::fill, PolygonMode::line, PolygonMode::point}),
                    .cull = random.pick({CullMode::none, CullMode::back}),
                    .provoking = random.pick({ProvokingVertex::first, ProvokingVertex::last})};
    const int samples = random.pick({1, 4});
    const Picture expected = draw(SmoothColorShader{}, soup.view(), indices, state, 1, samples);
    Picture p = draw(SameTriangles{}, soup.view(), indices, state, random.between(1, 3), samples);
    EXPECT_EQ(p.color, expected.color);
    EXPECT_EQ(p.statistics.geometry_invocations, p.statistics.primitives_in);
    p.statistics.geometry_invocations = 0;
    EXPECT_EQ(p.statistics, expected.statistics);
  }
}

// Emits the input only in some lanes, twice in others, and triangles that are smaller each time.
struct SomeTriangles : SmoothColorShader {
  static constexpr GeometryLayout geometry_layout{.max_vertices = 6};

  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    const IntOf<R> kind = in.primitive & IntOf<R>(3);
    for (int copy = 0; copy < 2; ++copy) {
      const R scale(copy == 0 ? 1.0f : 0.5f);
      for (std::size_t i = 0; i < 3; ++i) {
        const vec4<R> p = in.position[i];
        out.emit(vec4<R>(p.x * scale, p.y * scale, p.z - p.w * R(0.25f) * (R(1) - scale), p.w), in.varyings[i], kind > IntOf<R>(copy));
      }
      out.end_primitive();
    }
  }
};

TEST(GeometryStage, DropsAndMultipliesPrimitivesInOrder) {
  Random random(8);
  for (int i = 0; i < effort(20); ++i) {
    const Soup soup = random_vertices(random, 99);
    std::vector<uint32_t> list(99);
    for (uint32_t k = 0; k < 99; ++k) list[k] = k;
    Soup expanded;
    for (uint32_t t = 0; t < 33; ++t) {
      for (uint32_t copy = 0; copy < 2; ++copy) {
        if (t % 4 <= copy) continue;
        const float scale = copy == 0 ? 1.0f : 0.5f;
        for (uint32_t k = 0; k < 3; ++k) {
          const glm::vec4 p = soup.positions[3 * t + k];
          expanded.positions.push_back({p.x * scale, p.y * scale, p.z - p.w * 0.25f * (1.0f - scale), p.w});
          expanded.colors.push_back(soup.colors[3 * t + k]);
        }
      }
    }
    const DrawState state{.depth = {.test = random.coin()}};
    const Picture expected = draw(SmoothColorShader{}, expanded.view(), Indices::sequential(expanded.positions.size()), state);
    const Picture p = draw(SomeTriangles{}, soup.view(), list, state);
    EXPECT_EQ(p.color, expected.color);
    EXPECT_EQ(p.statistics.geometry_invocations, 33u);
    EXPECT_EQ(p.statistics.primitives_in, expected.statistics.primitives_in);
    EXPECT_EQ(p.statistics.vertices_shaded, 99u);
  }
}

// A quad around each point, as a strip, with a color for each strip.
struct Billboards {
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct VertexVaryings {
    vec4<R> color;
    R unused;
  };
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };
  static constexpr GeometryLayout geometry_layout{.input = GeometryInputPrimitive::points, .max_vertices = 4};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out = {in.color, R(1)};
    return in.position;
  }
  template <class R>
  void geometry(const GeometryInput<R, VertexVaryings<R>, 1>& in, Emitter<R, Varyings<R>>& out) const {
    for (int corner = 0; corner < 4; ++corner) {
      const vec4<R> p = in.position[0];
      const float x = (corner & 1) != 0 ? 0.0625f : -0.0625f, y = (corner & 2) != 0 ? 0.0625f : -0.0625f;
      out.emit(vec4<R>(p.x + R(x), p.y + R(y), p.z, p.w), {{in.varyings[0].color}});
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

TEST(GeometryStage, PointsBecomeQuads) {
  Soup soup;
  for (int i = 0; i < 40; ++i) {
    soup.positions.push_back(clip_position({256 * (4 + 8 * (i % 8)), 256 * (4 + 8 * (i / 8))}, kWidth, kHeight));
    soup.colors.push_back({1.0f, static_cast<float>(i), 0.0f, 1.0f});
  }
  const Picture p = draw(Billboards{}, soup.view(), Indices::sequential(40), {.topology = Topology::points, .cull = CullMode::back});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      // A quad has four pixels in each direction, and there are four between quads.
      const bool inside = (x + 2) % 8 >= 4 && (y + 2) % 8 >= 4 && y < 40;
      const glm::vec4 expected = inside ? glm::vec4(1.0f, static_cast<float>(x / 8 + y / 8 * 8), 0.0f, 1.0f) : glm::vec4(0.0f);
      EXPECT_EQ(pixel(p.color, x, y), expected) << x << ' ' << y;
    }
  }
  EXPECT_EQ(p.statistics.primitives_in, 80u);
}

// Records the numbers of the vertices of each primitive, by primitive.
struct Record {
  std::mutex mutex;
  std::vector<std::vector<int>> vertices;
};
template <GeometryInputPrimitive kInput>
struct Recorder {
  Record* record;
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  struct Varyings {
    Flat<IntOf<R>> number;
  };
  static constexpr GeometryLayout geometry_layout{.input = kInput, .output = GeometryOutputPrimitive::points, .max_vertices = 1};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.number.value = id.vertex;
    return in.position;
  }
  template <class R, std::size_t N>
  void geometry(const GeometryInput<R, Varyings<R>, N>& in, Emitter<R, Varyings<R>>&) const {
    const std::lock_guard lock(record->mutex);
    for (int i = 0; i < kWidthOf<R>; ++i) {
      const auto primitive = static_cast<std::size_t>(lane(in.primitive, i));
      if (record->vertices.size() <= primitive) record->vertices.resize(primitive + 1);
      record->vertices[primitive].clear();
      for (std::size_t v = 0; v < N; ++v) record->vertices[primitive].push_back(lane(in.varyings[v].number.value, i));
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

template <GeometryInputPrimitive kInput>
std::vector<std::vector<int>> received(Topology topology, const std::vector<uint32_t>& list,
                                       ProvokingVertex provoking = ProvokingVertex::last) {
  Record record;
  const std::vector<glm::vec4> positions(64, glm::vec4(0, 0, 0, 1));
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  const Indices indices(list, 64, PrimitiveRestart::on);
  pass.draw(Recorder<kInput>{&record}, make_vertex_view(stream(positions)), indices, {.topology = topology, .provoking = provoking});
  const PassStatistics s = pass.run(one_worker());
  EXPECT_EQ(s.geometry_invocations, record.vertices.size());
  EXPECT_EQ(s.primitives_in, 0u);
  return record.vertices;
}

std::vector<uint32_t> numbers(uint32_t n) {
  std::vector<uint32_t> list(n);
  for (uint32_t i = 0; i < n; ++i) list[i] = i;
  return list;
}

using Rows = std::vector<std::vector<int>>;

// OpenGL 4.6, sections 10.1.11 to 10.1.14.
TEST(GeometryStage, ReceivesAdjacentVerticesInOpenGlsOrder) {
  constexpr auto kLines = GeometryInputPrimitive::lines_adjacency;
  EXPECT_EQ(received<kLines>(Topology::lines_adjacency, numbers(9)), (Rows{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(received<kLines>(Topology::line_strip_adjacency, numbers(6)), (Rows{{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}}));
  constexpr auto kTriangles = GeometryInputPrimitive::triangles_adjacency;
  EXPECT_EQ(received<kTriangles>(Topology::triangles_adjacency, numbers(13)), (Rows{{0, 1, 2, 3, 4, 5}, {6, 7, 8, 9, 10, 11}}));
}

// OpenGL 4.6, table 10.1, with numbers from 0: corner, neighbor, corner, neighbor, corner, neighbor.
TEST(GeometryStage, ReceivesStripsOfTrianglesWithAdjacency) {
  const auto strip = [](uint32_t n) {
    return received<GeometryInputPrimitive::triangles_adjacency>(Topology::triangle_strip_adjacency, numbers(n));
  };
  EXPECT_EQ(strip(5), Rows{});
  EXPECT_EQ(strip(6), (Rows{{0, 1, 2, 5, 4, 3}}));
  EXPECT_EQ(strip(7), strip(6));
  EXPECT_EQ(strip(8), (Rows{{0, 1, 2, 6, 4, 3}, {4, 0, 2, 5, 6, 7}}));
  EXPECT_EQ(strip(10), (Rows{{0, 1, 2, 6, 4, 3}, {4, 0, 2, 5, 6, 8}, {4, 2, 6, 9, 8, 7}}));
  EXPECT_EQ(strip(12), (Rows{{0, 1, 2, 6, 4, 3}, {4, 0, 2, 5, 6, 8}, {4, 2, 6, 10, 8, 7}, {8, 4, 6, 9, 10, 11}}));
}

TEST(GeometryStage, ARestartBeginsANewStripWithAdjacency) {
  std::vector<uint32_t> list = numbers(8);
  list.insert(list.begin() + 3, 0xffffffffu);
  EXPECT_EQ(received<GeometryInputPrimitive::lines_adjacency>(Topology::line_strip_adjacency, list), (Rows{{3, 4, 5, 6}, {4, 5, 6, 7}}));
}

// The provoking vertex comes first or last, and each edge keeps its neighbor.
TEST(GeometryStage, TheProvokingVertexOfAStripIsFirstOrLast) {
  constexpr auto kTriangles = GeometryInputPrimitive::triangles;
  EXPECT_EQ(received<kTriangles>(Topology::triangle_strip, numbers(5)), (Rows{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
  EXPECT_EQ(received<kTriangles>(Topology::triangle_strip, numbers(5), ProvokingVertex::first), (Rows{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(received<GeometryInputPrimitive::triangles_adjacency>(Topology::triangle_strip_adjacency, numbers(8), ProvokingVertex::first),
            (Rows{{0, 1, 2, 6, 4, 3}, {2, 5, 6, 7, 4, 0}}));
}

TEST(GeometryStage, DrawsWithoutItIgnoreAdjacentVertices) {
  Random random(9);
  const Soup soup = random_vertices(random, 24);
  const auto corners = [&](Topology with, std::vector<uint32_t> list, Topology without, std::vector<uint32_t> expected) {
    return draw(SmoothColorShader{}, soup.view(), Indices(list, 24), {.topology = with}).color ==
           draw(SmoothColorShader{}, soup.view(), Indices(expected, 24), {.topology = without}).color;
  };
  EXPECT_TRUE(corners(Topology::lines_adjacency, numbers(8), Topology::lines, {1, 2, 5, 6}));
  EXPECT_TRUE(corners(Topology::line_strip_adjacency, numbers(8), Topology::line_strip, {1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(corners(Topology::triangles_adjacency, numbers(12), Topology::triangles, {0, 2, 4, 6, 8, 10}));
  EXPECT_TRUE(corners(Topology::triangle_strip_adjacency, numbers(12), Topology::triangle_strip, {0, 2, 4, 6, 8, 10}));
}

// Emits three strips: one with four vertices, one that is too short, and one that has no room.
struct Strips : FlatColorShader {
  static constexpr GeometryLayout geometry_layout{.max_vertices = 8, .invocations = 2};

  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    const auto number = [&](int strip, int v) {
      return vec4<R>(R(static_cast<float>(strip)), R(static_cast<float>(v)), R(static_cast<float>(in.invocation)), R(1));
    };
    constexpr std::array kSizes{4, 2, 5};
    out.end_primitive();  // without effect: no strip has begun
    for (int strip = 0; strip < 3; ++strip) {
      for (int v = 0; v < kSizes[static_cast<std::size_t>(strip)]; ++v) {
        // A zigzag of 4 px in the row of the strip and the invocation.
        const Point p{256 * 4 * (v / 2), 256 * (16 * strip + 8 * in.invocation + (v % 2 == 0 ? 0 : 8))};
        const glm::vec4 at = clip_position(p, kWidth, kHeight);
        out.emit(vec4<R>(R(at.x), R(at.y), R(at.z), R(at.w)), {{number(strip, v)}});
      }
      out.end_primitive();
      out.end_primitive();  // without effect: the strip has ended
    }
  }
};

TEST(GeometryStage, EndsStripsAndIgnoresVerticesBeyondTheLimit) {
  const std::vector<glm::vec4> positions = full_screen(), colors(3, glm::vec4(1.0f));
  for (const ProvokingVertex provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
    const Picture p = draw(Strips{}, make_vertex_view(stream(positions), stream(colors)), Indices::sequential(3), {.provoking = provoking});
    EXPECT_EQ(p.statistics.geometry_invocations, 2u);
    EXPECT_EQ(p.statistics.primitives_in, 4u);
    for (int invocation = 0; invocation < 2; ++invocation) {
      const auto place = static_cast<float>(invocation);
      const int y = 8 * invocation;
      EXPECT_EQ(pixel(p.color, 0, y), glm::vec4(0.0f, provoking == ProvokingVertex::first ? 0.0f : 2.0f, place, 1.0f));
      EXPECT_EQ(pixel(p.color, 3, y + 7), glm::vec4(0.0f, provoking == ProvokingVertex::first ? 1.0f : 3.0f, place, 1.0f));
      EXPECT_EQ(pixel(p.color, 4, y), glm::vec4(0.0f));
      EXPECT_EQ(pixel(p.color, 0, 32 + y), glm::vec4(0.0f)) << "two vertices are left for the third strip";
    }
  }
}

// Points whose size and clip distance depend on the instance.
struct SizedPoints : FlatColorShader {
  template <class R>
  using EmittedVertex = PerVertex<R, 1>;
  static constexpr GeometryLayout geometry_layout{
      .input = GeometryInputPrimitive::points, .output = GeometryOutputPrimitive::points, .max_vertices = 1};

  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 1>& in, Emitter<R, Varyings<R>, PerVertex<R, 1>>& out) const {
    vec4<R> p = in.position[0];
    p.x += to_real<R>(in.instance) * R(0.5f);
    out.emit({p, to_real<R>(in.instance) * R(2) + R(2), {to_real<R>(in.instance) - R(1)}}, in.varyings[0]);
  }
};

TEST(GeometryStage, EmitsPointSizesAndClipDistancesOfAllInstances) {
  const std::vector<glm::vec4> positions{{-0.75f, 0.0f, 0.0f, 1.0f}}, colors{glm::vec4(1.0f)};
  const Picture p = draw(SizedPoints{}, make_vertex_view(stream(positions), stream(colors)), Indices::sequential(1),
                         {.topology = Topology::points, .instances = 4});
  std::array<int, 4> pixels{};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) pixels[static_cast<std::size_t>(x / 16)] += pixel(p.color, x, y).x == 1.0f;
  }
  EXPECT_EQ(pixels, (std::array{0, 16, 36, 64}));  // instance 0 has a negative distance; the sides are 2, 4, 6 and 8 px
}

// Lines from the corners of each triangle along a direction.
struct Normals : SmoothColorShader {
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::line_strip, .max_vertices = 6};

  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      out.emit(in.position[i], in.varyings[i]);
      out.emit(in.position[i] + vec4<R>(R(0.25f), R(0.5f), R(0), R(0)), in.varyings[i]);
      out.end_primitive();
    }
  }
};

TEST(GeometryStage, TrianglesBecomeLines) {
  Random random(10);
  const Soup soup = random_vertices(random, 300);
  Soup lines;
  for (std::size_t i = 0; i < 300; ++i) {
    lines.positions.insert(lines.positions.end(), {soup.positions[i], soup.positions[i] + glm::vec4(0.25f, 0.5f, 0, 0)});
    lines.colors.insert(lines.colors.end(), 2, soup.colors[i]);
  }
  for (const int samples : {1, 4}) {
    for (const float width : {1.0f, 3.0f}) {
      const Picture expected =
          draw(SmoothColorShader{}, lines.view(), Indices::sequential(600), {.topology = Topology::lines, .line_width = width}, 1, samples);
      const Picture p = draw(Normals{}, soup.view(), Indices::sequential(300), {.line_width = width}, 2, samples);
      EXPECT_EQ(p.color, expected.color);
    }
  }
}

TEST(GeometryStage, DepthOnlyDrawsUseIt) {
  Random random(11);
  const Soup soup = random_vertices(random, 90);
  const auto depths = [&](const auto& shader) {
    Image<float> depth(kWidth, kHeight);
    Pass pass(kWidth, kHeight, std::span<const ColorTarget>{}, d32f_target(depth));
    pass.draw_depth(shader, soup.view());
    pass.run(one_worker());
    return depth;
  };
  EXPECT_EQ(depths(SameTriangles{}), depths(SmoothColorShader{}));
}

TEST(GeometryStage, TakesItsPlaceInTheOrderOfDrawsAndPassesCanRunAgain) {
  Random random(12);
  const Soup soup = random_vertices(random, 90);
  Image<glm::vec4> expected(kWidth, kHeight), color(kWidth, kHeight);
  Pass plain(kWidth, kHeight, rgba32f_target(expected), {.format = DepthFormat::d32f});
  Pass pass(kWidth, kHeight, rgba32f_target(color), {.format = DepthFormat::d32f});
  const DrawState over{.depth = {.test = false}, .blend = kAdd};
  for (int run = 0; run < 3; ++run) {
    const bool has_stage = run < 2;
    for (Pass* p : {&plain, &pass}) {
      p->draw(SmoothColorShader{}, soup.view());
      if (p == &plain || !has_stage) p->draw(SmoothColorShader{}, soup.view(), over);
      if (p == &pass && has_stage) p->draw(SameTriangles{}, soup.view(), over);
      p->draw(FlatColorShader{}, soup.view());
    }
    const PassStatistics all = plain.run(one_worker()), found = pass.run(one_worker());
    EXPECT_EQ(color, expected);
    if (!has_stage) {
      EXPECT_EQ(found, all) << "nothing is left of the draws of the runs before";
    }
  }
}

struct SubmittedNumbers : SomeTriangles {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const PrimitiveId<R>& id, const Pixel<R>&) const {
    return {vec4<R>(to_real<R>(id.primitive), to_real<R>(id.instance), R(0), R(1))};
  }
};

TEST(GeometryStage, PrimitiveNumbersAreThoseOfSubmittedPrimitives) {
  // Four triangles: none, one, two and two are emitted. The draw is blended, so that all are visible.
  Soup soup;
  for (int t = 0; t < 4; ++t) {
    for (const glm::vec4& corner : full_screen(0.5f)) soup.positions.push_back(corner);
    soup.colors.insert(soup.colors.end(), 3, glm::vec4(1.0f));
  }
  const DrawState state{.instances = 3, .depth = {.test = false}, .blend = kAdd};
  const Picture p = draw(SubmittedNumbers{}, soup.view(), Indices::sequential(12), state);
  constexpr int kNumbers = 1 + 2 + 2 + 3 + 3;
  EXPECT_EQ(pixel(p.color, kWidth / 2, kHeight / 2), glm::vec4(3 * kNumbers, 5 * (0 + 1 + 2), 0, 3 * 5));
}

TEST(GeometryStageDeathTest, OtherTopologiesAreRefused) {
  const std::vector<glm::vec4> positions = full_screen(), colors(3, glm::vec4(1.0f));
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  const auto view = make_vertex_view(stream(positions), stream(colors));
  EXPECT_DEATH(pass.draw(SameTriangles{}, view, {.topology = Topology::points}), "geometry function receives other primitives");
  EXPECT_DEATH(pass.draw(SameTriangles{}, view, {.topology = Topology::triangles_adjacency}), "receives other primitives");
  EXPECT_DEATH(pass.draw(Billboards{}, view, {.topology = Topology::lines}), "receives other primitives");
}

}  // namespace
}  // namespace halfspace::raster_test::geometry_stage_test
