// SPDX-License-Identifier: Apache-2.0
//
// Tests parts of the state and the stages before clipping with the naive pipeline: its pictures in float are those of a pass, bit for bit,
// and those in double differ from them by rounding errors.
#include "halfspace/raster/naive.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "raster/raster_test.h"

namespace halfspace::raster_test::naive_test {
namespace {

constexpr int kWidth = 70, kHeight = 45;

struct Mesh {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

Mesh heap(uint64_t seed, int triangles) {
  Random random(seed);
  Mesh m;
  for (int i = 0; i < triangles * 3; ++i) {
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    m.positions.push_back({number(-1.2, 1.2), number(-1.2, 1.2), number(-0.9, 0.9), number(0.8, 1.5)});
    m.colors.push_back({number(0, 1), number(0, 1), number(0, 1), 1});
  }
  return m;
}

// Draws one mesh, and another one with the state.
void expect_same(const DrawState& state) {
  const Mesh first = heap(1, 30), second = heap(2, 60);
  Image<glm::vec4> color(kWidth, kHeight);
  Image<float> depth(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(color), d32f_target(depth));
  NaiveTarget<float> naive(kWidth, kHeight, vec4<float>(0.0f), 1.0f);
  for (const auto& [mesh, with] : {std::pair(&first, DrawState{}), {&second, state}}) {
    pass.draw(SmoothColorShader{}, mesh->view(), with);
    draw_naive(naive, SmoothColorShader{}, mesh->view(), Indices::sequential(mesh->positions.size()), with);
  }
  const PassStatistics statistics = pass.run(one_worker());
  EXPECT_GT(statistics.samples_passed, 500u);
  EXPECT_EQ(std::memcmp(color.data(), naive.color.data(), sizeof(glm::vec4) * kWidth * kHeight), 0);
  EXPECT_EQ(depth, naive.depth);
}

TEST(Naive, OffsetsPolygons) {
  for (const float slope : {-1.5f, 0.0f, 2.0f}) {
    for (const float constant : {-300000.0f, 0.0f, 4.0f}) {
      expect_same({.offset = {.slope = slope, .constant = constant}});
      expect_same({.offset = {.slope = slope, .constant = constant, .clamp = slope < 0.0f ? -0.01f : 0.01f}});
    }
  }
}

TEST(Naive, TestsTheBoundsOfTheStoredDepth) {
  for (const auto& [low, high] : {std::pair(0.2f, 0.6f), {0.5f, 1.0f}, {0.0f, 0.4f}, {1.0f, 1.0f}}) {
    expect_same({.depth_bounds = StoredDepthRange{low, high}});
    expect_same({.depth = {.compare = CompareOp::greater}, .depth_bounds = StoredDepthRange{low, high}});
  }
}

// ---- distances, geometry functions and tessellation ----------------------------------------------------------------

constexpr int kWide = 150, kHigh = 100;  // six tiles

// Triangles or patches of both windings, some of which are partly behind the eye or outside of the view. size: in clip space.
Mesh scattered(uint64_t seed, int primitives, std::size_t corners, float size) {
  Random random(seed);
  const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
  Mesh m;
  for (int i = 0; i < primitives; ++i) {
    const float x = number(-1.1, 1.1), y = number(-1.1, 1.1), half = random.coin() ? 0.5f : -0.5f;
    for (std::size_t k = 0; k < corners; ++k) {
      const glm::vec2 corner(k == 1 || k == 2 ? half : -half, k >= 2 ? 0.5f : -0.5f);  // around the center, so that quads are not twisted
      const float w = random.once_in(9) ? number(-0.2, 0.2) : number(0.5, 2);
      m.positions.push_back(
          {w * x + size * (corner.x + number(-0.3, 0.3)), w * y + size * (corner.y + number(-0.3, 0.3)), w * number(-1.1, 0.9), w});
      m.colors.push_back({number(0, 1), number(0, 1), number(0, 1), number(-0.4, 9)});
    }
  }
  return m;
}

template <class S>
NaiveTarget<double> in_double(const S& shader, const Mesh& mesh, const DrawState& state) {
  NaiveTarget<double> target(kWide, kHigh, vec4<double>(0.0), 1.0);
  draw_naive(target, shader, mesh.view(), Indices::sequential(mesh.positions.size()), state);
  return target;
}

// Checks that the naive pipeline draws the same as a pass with several threads, and nearly the same in double. Returns the statistics.
//
// Both round the places of vertices to 1/256 px. In float, a place has an error of about 2^-24 of half the width, which is 2^14 steps of
// the grid, so that one of several hundred vertices is rounded to another step. Pixels at the edges of its triangles, and where these
// intersect others, can show another triangle, and values inside change by 2^-8 of the difference between two pixels. All other errors are
// those of interpolation, below 2^-18. So a few pixels can differ by more than 2^-12: in these tests, at most one of 15,000. The limit is
// one of a thousand.
template <class S>
PassStatistics expect_same_and_near(const S& shader, const Mesh& mesh, DrawState state) {
  const Indices indices = Indices::sequential(mesh.positions.size());
  NaiveTarget<float> naive(kWide, kHigh, vec4<float>(0.0f), 1.0f);
  draw_naive(naive, shader, mesh.view(), indices, state);
  if constexpr (HasTessellationLayout<S>) state.topology = Topology::patches;
  PassStatistics statistics;
  for (const int threads : {1, 3}) {
    Image<glm::vec4> color(kWide, kHigh);
    Image<float> depth(kWide, kHigh);
    Pass pass(kWide, kHigh, rgba32f_target(color), d32f_target(depth));
    pass.draw(shader, mesh.view(), indices, state);
    statistics = pass.run(Workers(threads));
    EXPECT_EQ(std::memcmp(color.data(), naive.color.data(), sizeof(glm::vec4) * kWide * kHigh), 0);
    EXPECT_EQ(depth, naive.depth);
  }
  EXPECT_GT(statistics.samples_passed, 3000u);
  const NaiveTarget<double> exact = in_double(shader, mesh, state);
  int differing = 0;
  for (int i = 0; i < kWide * kHigh; ++i) {
    const vec4<float>& a = naive.color.data()[i];
    const vec4<double>& b = exact.color.data()[i];
    double error = std::fabs(static_cast<double>(naive.depth.data()[i]) - exact.depth.data()[i]);
    for (int k = 0; k < 4; ++k) error = std::max(error, std::fabs(static_cast<double>(a[k]) - b[k]));
    differing += error > 0x1p-12;
  }
  EXPECT_LE(differing, kWide * kHigh / 1000);
  return statistics;
}

// States that differ in the provoking vertex and in the facing of triangles.
const std::vector<DrawState> kStates{
    {}, {.cull = CullMode::back, .provoking = ProvokingVertex::first}, {.cull = CullMode::back, .front = Winding::clockwise}};

// The distances depend on the color.
struct Distances : SmoothColorShader {
  template <class R>
  PerVertex<R, 2, 2> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {in.position, R(1), {in.color.x - R(0.25f), R(0.75f) - in.color.y}, {in.color.z - R(0.5f), R(0.75f) - in.color.z}};
  }
};

TEST(Naive, ClipsAndCullsByDistances) {
  const Mesh mesh = scattered(3, 120, 3, 0.9f);
  for (const DrawState& state : kStates) {
    const PassStatistics statistics = expect_same_and_near(Distances{}, mesh, state);
    EXPECT_GT(statistics.culled_outside, 10u);
    EXPECT_GT(statistics.clipped, 30u);
  }
}

// Every eighth vertex has a distance that is not finite; its triangles are not drawn.
struct InfiniteDistances : SmoothColorShader {
  template <class R>
  PerVertex<R, 1, 1> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color = in.color;
    const R large(0x1p127f), infinite(std::numeric_limits<float>::infinity());
    const IntOf<R> place = id.vertex & IntOf<R>(15);
    return {in.position, R(1), {select(place == IntOf<R>(0), infinite, large)}, {select(place == IntOf<R>(8), infinite, large)}};
  }
};

TEST(Naive, DoesNotDrawTrianglesWithInfiniteDistances) {
  const Mesh mesh = heap(3, 60);
  Image<glm::vec4> color(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(color), {.format = DepthFormat::d32f});
  pass.draw(InfiniteDistances{}, mesh.view());
  EXPECT_EQ(pass.run(one_worker()).culled_non_finite, 23u);  // vertices 0, 8, …, 176 of 180
  NaiveTarget<float> naive(kWidth, kHeight, vec4<float>(0.0f), 1.0f);
  draw_naive(naive, InfiniteDistances{}, mesh.view(), Indices::sequential(180));
  EXPECT_EQ(std::memcmp(color.data(), naive.color.data(), sizeof(glm::vec4) * kWidth * kHeight), 0);
  NaiveTarget<double> exact(kWidth, kHeight, vec4<double>(0.0), 1.0);
  draw_naive(exact, InfiniteDistances{}, mesh.view(), Indices::sequential(180));
  int differing = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) differing += (naive.depth.data()[i] < 1.0f) != (exact.depth.data()[i] < 1.0);
  EXPECT_LE(differing, kWidth * kHeight / 1000) << "pixels at the edges of triangles with a vertex that is rounded to another 1/256 px";
}

// Drops every fourth triangle, and draws two pictures of each other one: a parallelogram, and a smaller triangle in front of it.
struct Multiplied {
  static constexpr GeometryLayout geometry_layout{.max_vertices = 9, .invocations = 2};
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct VertexVaryings {
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec4<R> color;
    Flat<IntOf<R>> number;
  };
  template <class R>
  using EmittedVertex = PerVertex<R, 1, 1>;

  template <class R>
  PerVertex<R, 1> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.color = in.color;
    return {in.position, R(1), {R(-1)}};  // not passed on
  }
  template <class R>
  void geometry(const GeometryInput<R, VertexVaryings<R>, 3>& in, Emitter<R, Varyings<R>, EmittedVertex<R>>& out) const {
    const MaskOf<R> kept = (in.primitive & IntOf<R>(3)) != IntOf<R>(0);
    int number = 0;
    const auto emit = [&](const vec4<R>& p, const vec4<R>& color) {
      const vec4<R> moved(p.x + p.w * R(in.invocation == 0 ? -0.25f : 0.25f), p.y, p.z, p.w);
      out.emit({moved, R(1), {color.x - R(0.125f)}, {color.y - R(0.25f)}}, {color, {in.primitive + IntOf<R>(number++)}}, kept);
    };
    const auto& [a, b, c] = in.position;
    const vec4<R>&color_a = in.varyings[0].color, &color_b = in.varyings[1].color, &color_c = in.varyings[2].color;
    emit(a, color_a);
    emit(b, color_b);
    emit(c, color_c);
    emit(b + c - a, color_b);
    out.end_primitive();
    emit(a, color_b);  // too few vertices for a triangle
    emit(b, color_c);
    out.end_primitive();
    const auto nearer = [&](const vec4<R>& p) { return vec4<R>(p.x, p.y, p.z - p.w * R(0.125f), p.w); };
    emit(nearer((a + b) * R(0.5f)), color_c);
    emit(nearer((b + c) * R(0.5f)), color_a);
    emit(nearer((c + a) * R(0.5f)), color_b);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color.x, in.color.y, to_real<R>(in.number.value & IntOf<R>(7)) * R(0.125f), R(1))};
  }
};

TEST(Naive, DropsMovesAndMultipliesTrianglesInAGeometryFunction) {
  const Mesh mesh = scattered(4, 60, 3, 0.6f);
  for (const DrawState& state : kStates) {
    const PassStatistics statistics = expect_same_and_near(Multiplied{}, mesh, state);
    EXPECT_EQ(statistics.geometry_invocations, 120u);
    EXPECT_EQ(statistics.primitives_in, 45u * 2 * 3);
    EXPECT_GT(statistics.clipped, 10u);
  }
}

// Curved patches. The levels are the alpha of the corners; they are the same in float and in double.
template <TessellationDomain kDomain, TessellationSpacing kSpacing, bool kClockwise = false>
struct Curved {
  static constexpr std::size_t kCorners = kDomain == TessellationDomain::quads ? 4 : 3;
  static constexpr TessellationLayout tessellation_layout{
      .patch_vertices = static_cast<int>(kCorners), .domain = kDomain, .spacing = kSpacing, .clockwise = kClockwise};
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct VertexVaryings {
    vec3<R> color;
    R level;
  };
  template <class R>
  struct Patch {
    R height;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<R> place;
  };
  template <class R>
  using Input = PatchInput<R, VertexVaryings<R>, kCorners>;

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out = {vec3<R>(in.color), in.color.w};
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const Input<R>& in, Patch<R>& patch) const {
    patch.height = to_real<R>(in.patch & IntOf<R>(3));
    TessellationLevels<R> levels;
    for (std::size_t i = 0; i < 4; ++i) levels.outer[i] = in.varyings[i % kCorners].level;
    for (std::size_t i = 0; i < 2; ++i) levels.inner[i] = in.varyings[i].level;
    return levels;
  }
  template <class R>
  PerVertex<R, 1> evaluate(const Input<R>& in, const Patch<R>& patch, const vec3<R>& at, Varyings<R>& out) const {
    std::array<R, 4> weights{at.x, at.y, at.z, R(0)};
    const R u = R(1) - at.x, v = R(1) - at.y;
    if (kDomain == TessellationDomain::quads) weights = {u * v, at.x * v, at.x * at.y, u * at.y};
    vec4<R> p(R(0));
    out.color = vec3<R>(R(0));
    for (std::size_t i = 0; i < kCorners; ++i) {
      p += in.position[i] * weights[i];
      out.color += in.varyings[i].color * weights[i];
    }
    p.y += p.w * patch.height * (at.x * u * at.y * v);
    out.place.value = at.x;
    return {p, R(1), {out.color.x - R(0.25f)}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color.x, in.color.y, in.place.value, R(1))};
  }
};

template <class S>
void expect_divided(const S& shader, uint64_t seed, unsigned per_patch) {
  const Mesh mesh = scattered(seed, 30, S::kCorners, 0.9f);
  for (const DrawState& state : kStates) {
    const PassStatistics statistics = expect_same_and_near(shader, mesh, state);
    EXPECT_EQ(statistics.patches_in, 30u);
    EXPECT_GT(statistics.primitives_in, 30 * per_patch);
    EXPECT_GT(statistics.clipped, 10u);
  }
}

TEST(Naive, DividesPatches) {
  using Domain = TessellationDomain;
  using Spacing = TessellationSpacing;
  expect_divided(Curved<Domain::triangles, Spacing::equal>{}, 5, 10);
  expect_divided(Curved<Domain::triangles, Spacing::fractional_odd, true>{}, 6, 10);
  expect_divided(Curved<Domain::quads, Spacing::equal, true>{}, 7, 20);
  expect_divided(Curved<Domain::quads, Spacing::fractional_even>{}, 8, 20);
}

// Makes the triangles of patches smaller. The distances of the evaluation function are not passed on.
struct CurvedMosaic : Curved<TessellationDomain::quads, TessellationSpacing::fractional_odd> {
  static constexpr GeometryLayout geometry_layout{};
  template <class R>
  struct EvaluatedVaryings {
    vec3<R> color;
    Flat<R> place;
  };

  template <class R>
  vec4<R> evaluate(const Input<R>& in, const Patch<R>& patch, const vec3<R>& at, EvaluatedVaryings<R>& out) const {
    Varyings<R> varyings{};
    const PerVertex<R, 1> v = Curved::evaluate(in, patch, at, varyings);
    out = {varyings.color, varyings.place};
    return v.position;
  }
  template <class R>
  void geometry(const GeometryInput<R, EvaluatedVaryings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    const R third(1.0f / 3.0f);
    const vec4<R> center = (in.position[0] + in.position[1] + in.position[2]) * third;
    const R number = to_real<R>(in.primitive & IntOf<R>(1));
    for (std::size_t i = 0; i < 3; ++i)
      out.emit(in.position[i] * R(0.75f) + center * R(0.25f),
               {in.varyings[i].color, {in.varyings[i].place.value * R(0.5f) + number * R(0.5f)}});
  }
};

TEST(Naive, PassesDividedPatchesToAGeometryFunction) { expect_divided(CurvedMosaic{}, 9, 20); }

TEST(Naive, DrawsARangeOfPatchesWithoutAnIncompleteOne) {
  using Shader = Curved<TessellationDomain::quads, TessellationSpacing::equal>;
  const PassStatistics statistics =
      expect_same_and_near(Shader{}, scattered(10, 40, 4, 0.9f), {.first = 6, .count = 143, .base_vertex = -2});
  EXPECT_EQ(statistics.patches_in, 35u);
}

}  // namespace
}  // namespace halfspace::raster_test::naive_test
