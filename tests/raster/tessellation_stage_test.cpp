// SPDX-License-Identifier: Apache-2.0
//
// Tests the tessellation stages. The tessellator itself is tested in tessellator_test.cpp. Here, a draw of patches must give the pixels of
// a mesh that the test divides and evaluates by hand, and patches that share an edge must meet without a crack.
#include "halfspace/raster/amplify/tessellator.h"
#include "halfspace/raster/capture.h"

#include <cmath>

#include "raster/raster_test.h"

namespace halfspace::raster_test::tessellation_stage_test {
namespace {

constexpr int kWidth = 64, kHeight = 64;

// A bilinear patch with the given levels. The color is that of the evaluated point.
template <TessellationSpacing kSpacing, bool kPoints = false>
struct BilinearPatch {
  static constexpr TessellationLayout tessellation_layout{
      .patch_vertices = 4, .domain = TessellationDomain::quads, .spacing = kSpacing, .point_mode = kPoints};
  TessellationLevels<float> levels{};
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 4>&) const {
    TessellationLevels<R> out;
    for (std::size_t i = 0; i < 4; ++i) out.outer[i] = R(levels.outer[i]);
    for (std::size_t i = 0; i < 2; ++i) out.inner[i] = R(levels.inner[i]);
    return out;
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 4>& in, const vec3<R>& at, Varyings<R>& out) const {
    const auto between = [&](const vec4<R>& a, const vec4<R>& b, const R& t) { return a * (R(1) - t) + b * t; };
    const auto bilinear = [&](const auto& value) {
      return between(between(value(0), value(1), at.x), between(value(3), value(2), at.x), at.y);
    };
    out.color = bilinear([&](std::size_t i) { return in.varyings[i].color; });
    return bilinear([&](std::size_t i) { return in.position[i]; });
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

struct Vertices {
  std::vector<glm::vec4> positions, colors;
  auto view() const { return make_vertex_view(stream(positions), stream(colors)); }
};

struct Picture {
  Image<glm::vec4> color{kWidth, kHeight};
  PassStatistics statistics;
};

template <class S, class V, class I>
Picture draw(const S& shader, const V& view, const I& indices, const DrawState& state, int threads = 1) {
  Picture p;
  Pass pass(kWidth, kHeight, rgba32f_target(p.color), {.format = DepthFormat::d32f});
  pass.draw(shader, view, indices, state);
  p.statistics = pass.run(Workers(threads));
  return p;
}

float number(Random& random, double low, double high) { return static_cast<float>(random.real(low, high)); }

Vertices random_patches(Random& random, int count) {
  Vertices v;
  for (int i = 0; i < count; ++i) {
    const float x = number(random, -1.2, 0.6), y = number(random, -1.2, 0.6), size = number(random, 0.1, 1.0);
    for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
      const float w = number(random, 0.5, 2);
      v.positions.push_back(w * glm::vec4(x + size * corner.x + number(random, -0.1, 0.1), y + size * corner.y + number(random, -0.1, 0.1),
                                          number(random, -0.9, 0.9), 1.0f));
      v.colors.push_back({number(random, 0, 1), number(random, 0, 1), number(random, 0, 1), 1.0f});
    }
  }
  return v;
}

std::vector<uint32_t> numbers(std::size_t n) {
  std::vector<uint32_t> list(n);
  for (uint32_t i = 0; i < n; ++i) list[i] = i;
  return list;
}

// Divides the patches and evaluates them one vertex at a time. Returns triangles or points.
template <class S>
Vertices divided(const S& shader, const Vertices& patches) {
  constexpr TessellationLayout layout = S::tessellation_layout;
  Vertices out;
  Tessellation t;
  tessellate({layout.domain, layout.spacing, layout.clockwise, layout.point_mode}, shader.levels, t);
  for (std::size_t patch = 0; patch < patches.positions.size() / 4; ++patch) {
    PatchInputOf<S, float> in{};
    for (std::size_t i = 0; i < 4; ++i) {
      in.position[i] = vec4<float>(patches.positions[4 * patch + i]);
      in.varyings[i].color = vec4<float>(patches.colors[4 * patch + i]);
    }
    for (const uint32_t i : t.indices) {
      typename S::template Varyings<float> varyings{};
      out.positions.push_back(glm::vec4(shader.evaluate(in, vec3<float>(t.coordinates[i]), varyings)));
      out.colors.push_back(glm::vec4(varyings.color));
    }
  }
  return out;
}

template <TessellationSpacing kSpacing>
void expect_divided(uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < effort(12); ++i) {
    BilinearPatch<kSpacing> shader;
    for (float& level : shader.levels.outer) level = number(random, 0.5, 9);
    for (float& level : shader.levels.inner) level = number(random, 0.5, 9);
    const Vertices patches = random_patches(random, 35);
    const Vertices mesh = divided(shader, patches);
    const DrawState state{.polygon_mode = random.pick({PolygonMode::fill, PolygonMode::line}),
                          .cull = random.pick({CullMode::none, CullMode::front, CullMode::back})};
    DrawState patch_state = state;
    patch_state.topology = Topology::patches;
    const Picture expected = draw(SmoothColorShader{}, mesh.view(), Indices::sequential(mesh.positions.size()), state);
    const Picture p = draw(shader, patches.view(), numbers(140), patch_state, random.between(1, 3));
    EXPECT_EQ(p.color, expected.color);
    EXPECT_EQ(p.statistics.patches_in, 35u);
    EXPECT_EQ(p.statistics.vertices_shaded, 140u);
    EXPECT_EQ(p.statistics.primitives_in, mesh.positions.size() / 3);
    EXPECT_EQ(p.statistics.culled_face, expected.statistics.culled_face);
  }
}

TEST(TessellationStage, PatchesDrawTheDividedMesh) {
  expect_divided<TessellationSpacing::equal>(21);
  expect_divided<TessellationSpacing::fractional_even>(22);
  expect_divided<TessellationSpacing::fractional_odd>(23);
}

TEST(TessellationStage, EachVertexIsEvaluatedOnce) {
  Random random(24);
  BilinearPatch<TessellationSpacing::equal> shader;
  shader.levels = {{4, 4, 4, 4}, {4, 4}};
  const Vertices patches = random_patches(random, 3);
  const Picture p = draw(shader, patches.view(), numbers(12), {.topology = Topology::patches});
  EXPECT_EQ(p.statistics.vertices_evaluated, 3u * 25u);
  EXPECT_EQ(p.statistics.primitives_in, 3u * 32u);
}

TEST(TessellationStage, PointModeDrawsEachVertexAsAPoint) {
  BilinearPatch<TessellationSpacing::equal, true> shader;
  shader.levels = {{7, 7, 7, 7}, {7, 7}};
  Vertices square;
  // The vertices are on pixel centers, 8 px apart.
  for (const Point corner : {Point{4, 4}, Point{60, 4}, Point{60, 60}, Point{4, 60}}) {
    square.positions.push_back(clip_position({corner.x * 256 + 128, corner.y * 256 + 128}, kWidth, kHeight));
    square.colors.push_back(glm::vec4(1.0f));
  }
  const Picture p = draw(shader, square.view(), numbers(4), {.topology = Topology::patches});
  EXPECT_EQ(p.statistics.primitives_in, 64u);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) EXPECT_EQ(pixel(p.color, x, y).x, x % 8 == 4 && y % 8 == 4 ? 1.0f : 0.0f) << x << ' ' << y;
  }
}

// Lines of constant v, and nothing at v = 1.
struct Isolines : FlatColorShader {
  static constexpr TessellationLayout tessellation_layout{.patch_vertices = 2, .domain = TessellationDomain::isolines};
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 2>&) const {
    return {{R(4), R(2), R(0), R(0)}, {R(0), R(0)}};
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 2>& in, const vec3<R>& at, Varyings<R>& out) const {
    out = in.varyings[0];
    const vec4<R>&a = in.position[0], &b = in.position[1];
    return vec4<R>(a.x + (b.x - a.x) * at.x, a.y + (b.y - a.y) * at.y, a.z, a.w);
  }
};

TEST(TessellationStage, IsolinesDrawLinesBelowTheTopEdge) {
  Vertices v;
  v.positions = {clip_position({0, 128}, kWidth, kHeight), clip_position({256 * kWidth, 256 * kHeight + 128}, kWidth, kHeight)};
  v.colors.assign(2, glm::vec4(1.0f));
  const Picture p = draw(Isolines{}, v.view(), numbers(2), {.topology = Topology::patches});
  EXPECT_EQ(p.statistics.primitives_in, 8u);
  for (int y = 0; y < kHeight; ++y) {
    // By the diamond-exit rule, the line from 0 to 64 does not draw the pixel in which it ends.
    for (int x = 0; x < kWidth; ++x) EXPECT_EQ(pixel(p.color, x, y).x, y % 16 == 0 && x < kWidth - 1 ? 1.0f : 0.0f) << x << ' ' << y;
  }
}

// Bicubic patches whose shared edges have the same control points and levels. Each control point is in two to four patches.
struct BezierPatch {
  static constexpr TessellationLayout tessellation_layout{
      .patch_vertices = 16, .domain = TessellationDomain::quads, .spacing = TessellationSpacing::fractional_odd};
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  struct VertexVaryings {
    R level;
  };
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.level = in.position.z;
    return vec4<R>(in.position.x, in.position.y, R(0), in.position.w);
  }
  // The level of an edge depends on its two middle control points only, in an order that does not depend on the patch.
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, VertexVaryings<R>, 16>& in) const {
    const auto edge = [&](std::size_t a, std::size_t b) {
      return max(in.varyings[a].level, in.varyings[b].level) * R(8) + min(in.varyings[a].level, in.varyings[b].level);
    };
    return {{edge(4, 8), edge(1, 2), edge(7, 11), edge(13, 14)}, {in.varyings[5].level * R(9), in.varyings[10].level * R(9)}};
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, VertexVaryings<R>, 16>& in, const vec3<R>& at, Varyings<R>&) const {
    // Bernstein polynomials. At 1 − t they are those at t in reverse order, bit by bit, because 1 − t is exact.
    const auto weights = [](const R& t) {
      const R s = R(1) - t;
      return std::array<R, 4>{s * s * s, R(3) * t * (s * s), R(3) * s * (t * t), t * t * t};
    };
    const std::array<R, 4> u = weights(at.x), v = weights(at.y);
    vec4<R> p(R(0));
    for (int k = 0; k < 4; ++k) {
      // Opposite terms are added first, so that the sum does not depend on the direction of an edge.
      const auto row = [&](std::size_t j) {
        const auto term = [&](std::size_t i) { return in.position[4 * j + i][k] * u[i]; };
        return (term(0) + term(3)) + (term(1) + term(2));
      };
      p[k] = (row(0) * v[0] + row(3) * v[3]) + (row(1) * v[1] + row(2) * v[2]);
    }
    return p;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

TEST(TessellationStage, PatchesWithASharedEdgeMeetWithoutACrack) {
  Random random(25);
  constexpr int kPatches = 3, kSide = 3 * kPatches + 1;  // control points
  for (int i = 0; i < effort(30); ++i) {
    Vertices v;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        // The outer control points are on a frame around the view, and the inner ones move by a sixth of their distance.
        const bool outer = x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1;
        const auto at = [&](int k) {
          return 2.2f * static_cast<float>(k) / (kSide - 1) - 1.1f + (outer ? 0.0f : number(random, -0.04, 0.04));
        };
        const float px = at(x), py = at(y);
        v.positions.push_back({px, py, number(random, 0.1, 1), 1.0f});
      }
    }
    std::vector<uint32_t> list;
    for (int patch = 0; patch < kPatches * kPatches; ++patch) {
      const int x0 = 3 * (patch % kPatches), y0 = 3 * (patch / kPatches);
      const bool turned = random.coin();  // half of the patches are turned by 180 degrees, which turns their edges
      for (int k = 0; k < 16; ++k) {
        const int place = turned ? 15 - k : k;
        list.push_back(static_cast<uint32_t>((y0 + place / 4) * kSide + x0 + place % 4));
      }
    }
    Image<glm::vec4> image(kWidth, kHeight);
    Pass pass(kWidth, kHeight, rgba32f_target(image), {});
    pass.draw(BezierPatch{}, make_vertex_view(stream(v.positions)), list, {.topology = Topology::patches, .blend = kAdd});
    const PassStatistics s = pass.run(one_worker());
    EXPECT_GT(s.primitives_in, 300u);
    // Where few segments follow a curve, a triangle can be turned over; the pixel is then covered three times. A crack or an overlap of two
    // patches gives an even number.
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) ASSERT_EQ(std::fmod(pixel(image, x, y).x, 2.0f), 1.0f) << x << ' ' << y << ", picture " << i;
    }
  }
}

// The center of each triangle of a patch, as a point, with the numbers of the patch and the instance.
struct PatchCenters {
  static constexpr TessellationLayout tessellation_layout{};
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::points, .max_vertices = 1};
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  struct VertexVaryings {};
  template <class R>
  struct Patch {
    R level;
  };
  template <class R>
  struct EvaluatedVaryings {
    R level;
  };
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>&) const {
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, VertexVaryings<R>, 3>& in, Patch<R>& patch) const {
    patch.level = to_real<R>(in.patch);  // patch 0 is discarded
    return {{patch.level, patch.level, patch.level, patch.level}, {patch.level, patch.level}};
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, VertexVaryings<R>, 3>& in, const Patch<R>& patch, const vec3<R>& at,
                   EvaluatedVaryings<R>& out) const {
    out.level = patch.level;
    return in.position[0] * at.x + in.position[1] * at.y + in.position[2] * at.z;
  }
  template <class R>
  void geometry(const GeometryInput<R, EvaluatedVaryings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    const vec4<R> color(to_real<R>(in.primitive), to_real<R>(in.instance), in.varyings[2].level, R(1));
    out.emit((in.position[0] + in.position[1] + in.position[2]) * R(1.0f / 3.0f), {{color}});
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

TEST(TessellationStage, DividedPatchesReachTheGeometryStage) {
  std::vector<glm::vec4> positions;
  for (int patch = 0; patch < 4; ++patch) positions.insert(positions.end(), {{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}});
  const auto c =
      capture(PatchCenters{}, make_vertex_view(stream(positions)), two_workers(), {.topology = Topology::patches, .instances = 2});
  // Levels 1, 2 and 3 divide a triangle into 1, 6 and 13 triangles.
  ASSERT_EQ(c.primitives, 2u * (1 + 6 + 13));
  EXPECT_EQ(c.topology, Topology::points);
  std::size_t i = 0;
  for (int instance = 0; instance < 2; ++instance) {
    for (const auto& [patch, triangles] : {std::pair(1, 1), std::pair(2, 6), std::pair(3, 13)}) {
      for (int t = 0; t < triangles; ++t, ++i) {
        const vec4<float>& color = c.varyings[i].color.value;
        EXPECT_EQ(glm::vec3(color.x, color.y, color.z), glm::vec3(patch, instance, patch));
        EXPECT_LE(std::abs(c.positions[i].x), 1.0f);
      }
    }
  }
}

// Sixteen control points of a bicubic patch, moved by an amount that depends on the patch.
template <class R>
std::array<vec4<R>, 32> control_points_of(const auto& in) {
  std::array<vec4<R>, 32> points;  // positions, then colors
  for (std::size_t k = 0; k < 16; ++k) {
    const R u(static_cast<float>(k % 4) / 3.0f), v(static_cast<float>(k / 4) / 3.0f);
    const auto bilinear = [&](const auto& value) {
      const vec4<R> low = value(0) * (R(1) - u) + value(1) * u, high = value(3) * (R(1) - u) + value(2) * u;
      return low * (R(1) - v) + high * v;
    };
    points[k] = bilinear([&](std::size_t i) { return in.position[i]; });
    points[16 + k] = bilinear([&](std::size_t i) { return in.varyings[i].color; });
    points[k].z = points[k].z + in.varyings[0].color.x * R(k % 3 == 0 ? 0.25f : -0.25f);
  }
  return points;
}

template <class R>
vec4<R> bicubic(const vec4<R>* points, const vec3<R>& at) {
  const auto weights = [](const R& t) {
    const R s = R(1) - t;
    return std::array<R, 4>{s * s * s, R(3) * s * s * t, R(3) * s * t * t, t * t * t};
  };
  const std::array<R, 4> u = weights(at.x), v = weights(at.y);
  vec4<R> sum(R(0));
  for (std::size_t k = 0; k < 16; ++k) sum += points[k] * (u[k % 4] * v[k / 4]);
  return sum;
}

// The control function computes the control points once per patch, or the evaluation function computes them for each vertex.
struct CubicPatch : BilinearPatch<TessellationSpacing::equal> {
  template <class R>
  struct Patch {
    std::array<vec4<R>, 32> points;
  };
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 4>& in, Patch<R>& patch) const {
    patch.points = control_points_of<R>(in);
    return BilinearPatch::control(in);
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 4>&, const Patch<R>& patch, const vec3<R>& at, Varyings<R>& out) const {
    out.color = bicubic(&patch.points[16], at);
    return bicubic(patch.points.data(), at);
  }
};
struct CubicVertices : BilinearPatch<TessellationSpacing::equal> {
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 4>& in, const vec3<R>& at, Varyings<R>& out) const {
    const std::array<vec4<R>, 32> points = control_points_of<R>(in);
    out.color = bicubic(&points[16], at);
    return bicubic(points.data(), at);
  }
};

TEST(TessellationStage, ControlFunctionsReturnControlPoints) {
  Random random(21);
  const Vertices patches = random_patches(random, 37);
  const std::vector<uint32_t> list = numbers(patches.positions.size());
  const TessellationLevels<float> levels{{5, 6, 7, 3}, {4, 6}};
  CubicPatch once{};
  CubicVertices often{};
  once.levels = often.levels = levels;
  const DrawState state{.topology = Topology::patches};
  const Picture a = draw(once, patches.view(), list, state, 2), b = draw(often, patches.view(), list, state);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.statistics, b.statistics);
  EXPECT_GT(a.statistics.samples_passed, 1000u);
}

TEST(TessellationStage, RestartsDropIncompletePatches) {
  Random random(26);
  const Vertices patches = random_patches(random, 3);
  BilinearPatch<TessellationSpacing::equal> shader;
  const std::vector<uint32_t> list{0, 1, 0xffffffffu, 0, 1, 2, 3, 0xffffffffu, 4, 5, 6, 0xffffffffu, 8, 9, 10, 11, 4};
  const Indices indices(list, 12, PrimitiveRestart::on);
  const Picture p = draw(shader, patches.view(), indices, {.topology = Topology::patches});
  EXPECT_EQ(p.statistics.patches_in, 2u);
  const std::vector<uint32_t> whole{0, 1, 2, 3, 8, 9, 10, 11};
  EXPECT_EQ(p.color, draw(shader, patches.view(), whole, {.topology = Topology::patches}).color);
}

TEST(TessellationStageDeathTest, PatchesNeedTessellation) {
  Random random(27);
  const Vertices patches = random_patches(random, 1);
  Image<glm::vec4> image(kWidth, kHeight);
  Pass pass(kWidth, kHeight, rgba32f_target(image), {});
  EXPECT_DEATH(pass.draw(SmoothColorShader{}, patches.view(), {.topology = Topology::patches}), "patches need a shader with tessellation");
  EXPECT_DEATH(pass.draw(BilinearPatch<TessellationSpacing::equal>{}, patches.view()), "patches need a shader with tessellation");
}

}  // namespace
}  // namespace halfspace::raster_test::tessellation_stage_test
