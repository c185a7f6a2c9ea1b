// SPDX-License-Identifier: Apache-2.0
//
// Tests PrimitiveId: the indices and barycentric coordinates that a fragment function can receive. Expected values come from grids with
// cells that are known in closed form, and from solving the projection of a clipped triangle in double precision.
#include <cmath>
#include <functional>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

// Writes the primitive index, the instance index, a number that identifies the draw, and the barycentric coordinates. Instances are side by
// side.
template <template <class R, class... Colors> class Result>
struct IdShader {
  int32_t draw = 0;
  float step_x = 0.0f;  // NDC

  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  struct Varyings {
    vec2<R> unused;  // varyings and barycentric coordinates are stored side by side
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.unused = vec2<R>(in.position);
    vec4<R> p = in.position;
    p.x += p.w * R(step_x * static_cast<float>(id.instance));
    return p;
  }
  template <class R>
  Result<R, uvec4<R>, uvec4<R>, uvec4<R>, vec4<R>> fragment(const Varyings<R>&, const PrimitiveId<R>& id, const Pixel<R>&) const {
    Result<R, uvec4<R>, uvec4<R>, uvec4<R>, vec4<R>> out;
    const auto number = [](IntOf<R> i) { return uvec4<R>(UintOf<R>(i)); };
    out.color = {number(id.primitive), number(id.instance), number(IntOf<R>(draw)), vec4<R>(id.barycentrics, R(1))};
    if constexpr (requires { out.keep; }) out.keep = MaskOf<R>(true);
    return out;
  }
};
using Ids = IdShader<TypedFragment>;
using DiscardingIds = IdShader<DiscardingTypedFragment>;

constexpr int kWidth = 128, kHeight = 64;

struct Labels {
  Image<uint32_t> primitive{kWidth, kHeight}, instance{kWidth, kHeight}, draw{kWidth, kHeight};
  Image<glm::vec3> barycentrics{kWidth, kHeight};

  friend bool operator==(const Labels&, const Labels&) = default;
};

Labels draw_labels(const std::function<void(Pass&)>& add, const PassOptions& options = {}, int threads = 1) {
  Labels out;
  const std::array targets{r32ui_target(out.primitive, kNoSlot), r32ui_target(out.instance, kNoSlot), r32ui_target(out.draw, kNoSlot),
                           rgb32f_target(out.barycentrics)};
  Pass pass(kWidth, kHeight, targets, {.format = DepthFormat::d32f}, options);
  add(pass);
  pass.run(Workers(threads));
  return out;
}

struct Grid {
  int columns, rows, cell_width, cell_height;
  std::vector<glm::vec4> positions;
  std::vector<uint32_t> indices;
};

// A grid at the lower left. The triangles of a cell are (lower left, lower right, upper left) and (upper right, upper left, lower right).
// No pixel center is on an edge for cells of 8x6 or 4x3 pixels.
Grid make_grid(int columns, int rows, int cell_width, int cell_height, float w = 1.0f) {
  Grid g{columns, rows, cell_width, cell_height, {}, {}};
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x)
      g.positions.push_back(w * clip_position({x * cell_width * 256, y * cell_height * 256}, kWidth, kHeight));
  }
  const auto at = [&](int x, int y) { return static_cast<uint32_t>(y * (columns + 1) + x); };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      for (const uint32_t i : {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)}) g.indices.push_back(i);
    }
  }
  return g;
}

struct Label {
  uint32_t triangle;
  glm::dvec3 barycentrics;
};

// Returns what the grid shows at a pixel inside it.
Label label_of(const Grid& g, int x, int y) {
  const double u = (x % g.cell_width + 0.5) / g.cell_width, v = (y % g.cell_height + 0.5) / g.cell_height;
  const auto cell = static_cast<uint32_t>(y / g.cell_height * g.columns + x / g.cell_width);
  if (u + v < 1) return {2 * cell, {1 - u - v, u, v}};
  return {2 * cell + 1, {u + v - 1, 1 - u, 1 - v}};
}

double distance_of(const glm::vec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = glm::abs(glm::dvec3(a) - b);
  return std::max({d.x, d.y, d.z});
}

// Compares the part of the picture that starts at column x0 with the grid.
void expect_grid(const Labels& labels, const Grid& g, int x0, uint32_t draw, uint32_t instance, uint32_t triangle_step = 1,
                 uint32_t first_triangle = 0) {
  for (int y = 0; y < g.rows * g.cell_height; ++y) {
    for (int x = 0; x < g.columns * g.cell_width; ++x) {
      const Label expected = label_of(g, x, y);
      ASSERT_EQ(pixel(labels.primitive, x0 + x, y), expected.triangle * triangle_step + first_triangle) << x << ", " << y;
      ASSERT_EQ(pixel(labels.instance, x0 + x, y), instance);
      ASSERT_EQ(pixel(labels.draw, x0 + x, y), draw);
      ASSERT_LE(distance_of(pixel(labels.barycentrics, x0 + x, y), expected.barycentrics), 1e-6) << x << ", " << y;
    }
  }
}

// Several ways to render the same labels.
std::vector<std::pair<PassOptions, int>> ways() {
  return {{{}, 1},
          {{}, 8},
          {{.tuning = {.defer = false}}, 1},
          {{.tuning = {.tile_size = 8, .chunk_triangles = 7}}, 8},
          {{.tuning = {.tile_size = 16, .chunk_triangles = 3, .bin_budget = 1, .defer = false}}, 8},
          {{.tuning = {.tile_size = 32, .chunk_triangles = 5, .bin_budget = 1}}, 1}};
}

TEST(PrimitiveId, GridsHaveKnownIdsAndBarycentrics) {
  for (const auto& [width, height] : {std::pair(8, 6), std::pair(4, 3)}) {  // 4x3: packets with more than two triangles
    const Grid g = make_grid(kWidth / width, kHeight / height, width, height);
    const auto add = [&](Pass& pass) { pass.draw(Ids{.draw = 5}, make_vertex_view(stream(g.positions)), g.indices); };
    const Labels first = draw_labels(add);
    expect_grid(first, g, 0, 5, 0);
    EXPECT_EQ(pixel(first.primitive, 0, kHeight - 1), kNoSlot);  // above the grid
    EXPECT_EQ(pixel(first.barycentrics, 0, kHeight - 1), glm::vec3(0.0f));
    for (const auto& [options, threads] : ways()) EXPECT_EQ(draw_labels(add, options, threads), first);
    const auto add_discarding = [&](Pass& pass) { pass.draw(DiscardingIds{.draw = 5}, make_vertex_view(stream(g.positions)), g.indices); };
    EXPECT_EQ(draw_labels(add_discarding, {}, 8), first);
  }
}

TEST(PrimitiveId, CountsInstancesAndDraws) {
  const Grid g = make_grid(4, 10, 8, 6);
  const Indices indices(g.indices, g.positions.size());
  const float step = 2.0f * 32 / kWidth;
  const auto add = [&](Pass& pass) {
    pass.draw(Ids{.draw = 1, .step_x = step}, make_vertex_view(stream(g.positions)), indices, {.instances = 3});
    std::vector<glm::vec4> moved = g.positions;
    for (glm::vec4& p : moved) p.x += 3 * step;
    static std::vector<glm::vec4> kept;
    kept = moved;
    pass.draw(Ids{.draw = 2}, make_vertex_view(stream(kept)), indices);
  };
  const Labels first = draw_labels(add);
  for (uint32_t i = 0; i < 3; ++i) expect_grid(first, g, static_cast<int>(i) * 32, 1, i);
  expect_grid(first, g, 96, 2, 0);
  for (const auto& [options, threads] : ways()) EXPECT_EQ(draw_labels(add, options, threads), first);
}

TEST(PrimitiveId, CountsTrianglesThatAreNotDrawn) {
  const Grid g = make_grid(16, 10, 8, 6);
  std::vector<uint32_t> indices;  // a degenerate triangle, a back face, the triangle, and the triangle again behind it
  for (std::size_t i = 0; i < g.indices.size(); i += 3) {
    const uint32_t a = g.indices[i], b = g.indices[i + 1], c = g.indices[i + 2];
    for (const uint32_t k : {a, a, b, a, c, b, a, b, c, a, b, c}) indices.push_back(k);
  }
  for (const bool last_wins : {false, true}) {
    const auto add = [&](Pass& pass) {
      DrawState state{.cull = CullMode::back};
      if (last_wins) state.depth.compare = CompareOp::less_equal;
      pass.draw(Ids{}, make_vertex_view(stream(g.positions)), indices, state);
    };
    const Labels first = draw_labels(add);
    expect_grid(first, g, 0, 0, 0, 4, last_wins ? 3 : 2);
    for (const auto& [options, threads] : ways()) EXPECT_EQ(draw_labels(add, options, threads), first);
  }
}

TEST(PrimitiveId, FollowsStripsAndProvokingVertices) {
  const Grid g = make_grid(15, 1, 8, 6);
  std::vector<glm::vec4> positions;
  for (int x = 0; x <= 15; ++x) {
    for (int y = 0; y < 2; ++y) positions.push_back(clip_position({x * 2048, (1 - y) * 1536}, kWidth, kHeight));
  }
  for (const ProvokingVertex provoking : {ProvokingVertex::last, ProvokingVertex::first}) {
    const auto add = [&](Pass& pass) {
      pass.draw(Ids{}, make_vertex_view(stream(positions)), {.topology = Topology::triangle_strip, .provoking = provoking});
    };
    const Labels labels = draw_labels(add);
    for (int x = 0; x < 120; ++x) {
      for (int y = 0; y < 6; ++y) {
        // Vertices of cell c: 2c upper left, 2c + 1 lower left, 2c + 2 upper right, 2c + 3 lower right.
        const double u = (x % 8 + 0.5) / 8, v = (y + 0.5) / 6;
        const bool left = u < v;
        ASSERT_EQ(pixel(labels.primitive, x, y), static_cast<uint32_t>(x / 8 * 2 + (left ? 0 : 1)));
        const double upper_left = v - u, lower_left = 1 - v, upper_right = u;       // triangle (2c, 2c + 1, 2c + 2)
        const double second_lower = 1 - u, second_upper = v, second_right = u - v;  // (2c + 1, 2c + 2, 2c + 3)
        const glm::dvec3 odd = provoking == ProvokingVertex::last ? glm::dvec3(second_upper, second_lower, second_right)
                                                                  : glm::dvec3(second_lower, second_right, second_upper);
        ASSERT_LE(distance_of(pixel(labels.barycentrics, x, y), left ? glm::dvec3(upper_left, lower_left, upper_right) : odd), 1e-6);
      }
    }
  }
}

// Returns the barycentric coordinates of the point of a triangle in clip space that is projected to the center of a pixel.
glm::dvec3 projected_at(const std::array<glm::vec4, 3>& t, int x, int y) {
  const glm::dvec3 ndc((x + 0.5) / kWidth * 2 - 1, (y + 0.5) / kHeight * 2 - 1, 1);
  const glm::dmat3 m(glm::dvec3(t[0].x, t[0].y, t[0].w), glm::dvec3(t[1].x, t[1].y, t[1].w), glm::dvec3(t[2].x, t[2].y, t[2].w));
  const glm::dvec3 b = glm::inverse(m) * ndc;
  return b / (b.x + b.y + b.z);
}

TEST(PrimitiveId, ClippedTrianglesKeepTheirBarycentrics) {
  // The triangles cross the near plane, the plane w = 0 and the guard band.
  const std::vector<std::array<glm::vec4, 3>> triangles{{{{-3, -1, 0.5f, 1}, {4, -2, -2, 1}, {0.3f, 2.5f, 0.2f, 2}}},
                                                        {{{0.1f, 0.2f, -0.5f, -0.5f}, {-3, -2, 1, 4}, {2, -3, 2, 3}}},
                                                        {{{-400, -1, 0, 1}, {400, -1.5f, 0, 1}, {0, 1.5f, 0, 1}}}};
  for (const auto& t : triangles) {
    const std::vector<glm::vec4> positions(t.begin(), t.end());
    const auto add = [&](Pass& pass) {
      const std::vector<uint32_t> nothing_first{0, 0, 1, 0, 1, 2};
      static std::vector<uint32_t> kept;
      kept = nothing_first;
      pass.draw(Ids{}, make_vertex_view(stream(positions)), kept);
    };
    const Labels first = draw_labels(add);
    int covered = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (pixel(first.primitive, x, y) == kNoSlot) continue;
        ++covered;
        ASSERT_EQ(pixel(first.primitive, x, y), 1u);
        ASSERT_LE(distance_of(pixel(first.barycentrics, x, y), projected_at(t, x, y)), 1e-3) << x << ", " << y;  // vertices are snapped
      }
    }
    EXPECT_GT(covered, 500);
    for (const auto& [options, threads] : ways()) EXPECT_EQ(draw_labels(add, options, threads), first);
  }
}

TEST(PrimitiveId, PointsAndLines) {
  std::vector<glm::vec4> positions;
  for (int i = 0; i < 12; ++i) positions.push_back(clip_position({(i * 10 + 3) * 256, (i * 5 + 3) * 256}, kWidth, kHeight));
  positions[4].x = 7.0f;  // outside
  const Labels points = draw_labels(
      [&](Pass& pass) { pass.draw(Ids{}, make_vertex_view(stream(positions)), {.topology = Topology::points, .point_size = 4.0f}); });
  const Labels lines =
      draw_labels([&](Pass& pass) { pass.draw(Ids{}, make_vertex_view(stream(positions)), {.topology = Topology::line_strip}); });
  const Labels smooth_lines = draw_labels(
      [&](Pass& pass) { pass.draw(Ids{}, make_vertex_view(stream(positions)), {.topology = Topology::line_strip, .line_width = 3.0f}); },
      {.samples = 4});
  for (int i = 0; i < 12; ++i) {
    if (i == 4) continue;
    EXPECT_EQ(pixel(points.primitive, i * 10 + 3, i * 5 + 3), static_cast<uint32_t>(i));
    EXPECT_EQ(pixel(points.barycentrics, i * 10 + 3, i * 5 + 3), glm::vec3(1, 0, 0));
  }
  for (int i = 0; i < 11; ++i) {
    if (i == 3 || i == 4) continue;
    const int x = i * 10 + 7, y = i * 5 + 5;
    EXPECT_EQ(pixel(lines.primitive, x, y), static_cast<uint32_t>(i));
    EXPECT_LE(distance_of(pixel(lines.barycentrics, x, y), {0.55, 0.45, 0}), 0.02) << i;
    EXPECT_EQ(pixel(smooth_lines.primitive, x, y), static_cast<uint32_t>(i));
    EXPECT_LE(distance_of(pixel(smooth_lines.barycentrics, x, y), {0.55, 0.45, 0}), 0.02) << i;
  }
}

}  // namespace
}  // namespace halfspace::raster_test
