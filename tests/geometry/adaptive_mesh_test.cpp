// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/adaptive_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "geometry/mesh_checks.h"
#include "geometry/rough_map.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/point_surface.h"
#include "halfspace/geometry/shapes.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr PatchGrid kBall{.columns = 8, .rows = 4, .closed_u = true, .closed_v = false};
constexpr double kBallSize = 2.0, kBumpScale = 0.3, kBumpZero = 0.5;

const HeightField& bumpy_field() {
  static const HeightField field(rough_map(32, 16, 7), 0.7, two_workers());
  return field;
}

const SphereSurface& bumpy_ball() {
  static const SphereSurface sphere(&bumpy_field(), kBallSize, kBumpScale, kBumpZero);
  return sphere;
}

// A height over the unit square.
PointSurface sheet_of(double (*height)(double u, double v)) {
  const auto point = [height](double u, double v) {
    MeshPoint p{};
    p.position = {u, -v, height(u, v)};
    p.du = {1, 0, 0};
    p.normal = {0, 0, 1};
    return p;
  };
  return {point, std::nullopt};
}

double exact_error(const glm::dvec3&, double, double error) { return error; }

// An error from 0 to 7 that depends on the bits of the center, as if at random.
double random_error(uint32_t seed, const glm::dvec3& center) {
  uint32_t hash = seed;
  for (int k = 0; k < 3; ++k) hash = (hash ^ static_cast<uint32_t>(static_cast<int>(center[k] * 65536.0))) * 2654435761u;
  return static_cast<double>(hash >> 29);
}

AdaptiveMesh adapted(const ParametricSurface& s, const PatchGrid& grid, const ViewedError& viewed) {
  return AdaptiveSurface(s, grid).mesh(viewed, two_workers(), "test");
}

const PointSurface& bowl() {
  static const PointSurface sheet = sheet_of([](double u, double v) { return u * u + v * v; });
  return sheet;
}

// A paraboloid: the middle of a hypotenuse (du, dv) is (du² + dv²)/4 below its chord, and this is the largest deviation in the triangle.
TEST(MeasuredSquare, ErrorsOfAParaboloidAreItsChordErrors) {
  const MeasuredSquare whole(bowl(), {}, {}), quarter(bowl(), {}, SquarePlace{}.quarter(2));
  for (int h = 1; h < 16; h *= 2) {
    const double squared = std::pow(2.0 * h / 16.0, 2);  // of the side that the vertex bisects
    // The tolerance is for positions rounded to float: three times 2^-24 of at most 2.
    EXPECT_NEAR(whole.error({h, h}), 2 * squared / 4, 4e-7) << "center of a square, step " << h;
    EXPECT_NEAR(quarter.error({h, 16 - h}), squared / 4 / 2, 4e-7) << "center of a square of a quarter, step " << h;
    if (h < 8) {
      EXPECT_NEAR(whole.error({h, 2 * h}), squared / 4, 4e-7) << "middle of a side, step " << h;
    }
  }
  EXPECT_NEAR(whole.finest_error(), std::pow(2.0 / 16.0, 2) / 4, 4e-7);
}

// Only one vertex is high. Every triangle around it has its error.
TEST(MeasuredSquare, EveryVertexOfTheGridCounts) {
  const PointSurface spike = sheet_of([](double u, double v) { return u == 5.0 / 16 && v == 11.0 / 16 ? 1.0 : 0.0; });
  const MeasuredSquare square(spike, {}, {});
  const GridVertex spiked{5, 11};
  const auto side = [spiked](GridVertex a, GridVertex b) { return (b.i - a.i) * (spiked.j - a.j) - (b.j - a.j) * (spiked.i - a.i); };
  int around = 0;
  const std::function<void(const GridTriangle&)> check = [&](const GridTriangle& t) {
    if (!t.can_split() || t.apex == spiked || t.b == spiked || t.c == spiked) return;
    if (side(t.apex, t.b) > 0 || side(t.b, t.c) > 0 || side(t.c, t.apex) > 0) return;  // counter-clockwise if v points down
    EXPECT_GE(square.error(t.split()), 1.0);
    ++around;
    check(t.first());
    check(t.second());
  };
  for (const int half : {0, 1}) check(square_half(half, 16, true));
  EXPECT_GE(around, 6);
  EXPECT_EQ(square.error({14, 14}), 0.0);
}

TEST(AdaptiveMesh, FlatPatchesStayWhole) {
  const PointSurface sheet = sheet_of([](double, double) { return 0.0; });
  const AdaptiveMesh m = adapted(sheet, {.columns = 3, .rows = 2}, {exact_error, 1e-6});
  EXPECT_EQ(m.mesh.indices.size(), 3u * 2 * 6);
  EXPECT_EQ(m.mesh.positions.size(), 4u * 6);
  EXPECT_EQ(m.columns, 3 * 16);
}

// In a paraboloid, all triangles of a size have the same error.
TEST(AdaptiveMesh, TrianglesOfAParaboloidHaveOneSize) {
  for (const int level : {2, 4, 5, 7}) {
    const double allowed = 1.01 * 2 * std::pow(0.5, 2 * level) / 4;  // just above the error of halves of squares with sides of 2^-level
    const AdaptiveMesh m = adapted(bowl(), {}, {exact_error, allowed});
    EXPECT_EQ(m.mesh.indices.size(), std::size_t{6} << (2 * level));
    EXPECT_NEAR(m.error, allowed / 1.01, 4e-7);
  }
}

TEST(AdaptiveMesh, HasNoCracksForAnyChoice) {
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    // The error is random: 0.5 to 7.5. One or three of eight triangles are not bisected, so that branches end at each depth.
    const ViewedError viewed{
        [=](const glm::dvec3& center, double radius, double) { return radius > 0.1 ? random_error(seed, center) + 0.5 : 0.0; },
        seed % 3 == 0 ? 3.0 : 1.0};
    expect_closed(adapted(bumpy_ball(), kBall, viewed).mesh);
    expect_closed(adapted(PointSurface([](double u, double v) { return torus_point(2.0, 0.5, u, v); }, {}),
                          {.columns = 5, .rows = 3, .closed_u = true, .closed_v = true}, viewed)
                      .mesh);
  }
}

TEST(AdaptiveMesh, TrianglesFaceOutward) { expect_outward(adapted(bumpy_ball(), kBall, {exact_error, 0.01}).mesh); }

// Between the vertices of the grid, the surface deviates by at most its own chord error in a cell. It is measured here as the error of the
// finest squares.
TEST(AdaptiveMesh, NoPointIsOffByMoreThanTheAllowedError) {
  for (const double allowed : {0.1, 0.02, 0.005}) {
    const AdaptiveMesh adaptive = adapted(bumpy_ball(), kBall, {exact_error, allowed});
    const Mesh& m = adaptive.mesh;
    double largest = 0.0;
    for (std::size_t i = 0; i < m.indices.size(); i += 3) {
      const Corner a = corner(m, i), b = corner(m, i + 1), c = corner(m, i + 2);
      for (int s = 0; s <= 6; ++s) {
        for (int t = 0; s + t <= 6; ++t) {
          const double x = s / 6.0, y = t / 6.0;
          const auto between = [&](const auto& p, const auto& q, const auto& r) { return (1 - x - y) * p + x * q + y * r; };
          const glm::dvec2 uv = between(glm::dvec2(a.uv), glm::dvec2(b.uv), glm::dvec2(c.uv));
          const glm::dvec3 flat = between(glm::dvec3(a.position), glm::dvec3(b.position), glm::dvec3(c.position));
          largest = std::max(largest, glm::length(flat - glm::dvec3(bumpy_ball().at(uv.x, uv.y).position)));
        }
      }
    }
    EXPECT_LE(adaptive.error, allowed);
    // Errors are measured at vertices. Between them, the surface may be farther off: here, by a quarter of the allowed error at most.
    EXPECT_LE(largest, 1.25 * allowed);
    EXPECT_GE(largest, 0.5 * allowed) << "the mesh is finer than necessary";
  }
}

// A peak between the vertices of the coarsest grid is found if the caller says that something may be there.
TEST(AdaptiveMesh, FindsWhatMayBeBetweenTheVertices) {
  const PointSurface peak = sheet_of([](double u, double v) { return u == 21.0 / 64 && v == 33.0 / 64 ? 1.0 : 0.0; });
  const ViewedError blind{exact_error, 0.1}, careful{exact_error, 0.1, [](int columns, int) { return columns < 64 ? 1.0 : 0.0; }};
  EXPECT_EQ(adapted(peak, {}, blind).mesh.indices.size(), 6u);
  const Mesh m = adapted(peak, {}, careful).mesh;
  EXPECT_TRUE(std::ranges::any_of(m.positions, [](const glm::vec3& p) { return p.z == 1.0f; }));
  EXPECT_LT(m.indices.size(), 3u * 2 * 64 * 64 / 8) << "only the surroundings are fine";
}

// A roof with a peak of 0.8 on it, between the vertices of the coarsest grid. The peak is 1.55 above the whole square, but 0.8 above the
// roof, and the ridge is 0.8 above the square. With 1 allowed, only the roof is needed.
TEST(AdaptiveMesh, AddsWhatQuartersMeasure) {
  const PointSurface roof =
      sheet_of([](double u, double v) { return 0.8 * (1.0 - std::abs(2.0 * u - 1.0)) + (u == 15.0 / 32 && v == 15.0 / 32 ? 0.8 : 0.0); });
  const AdaptiveMesh m = adapted(roof, {}, {exact_error, 1.0, [](int columns, int) { return columns < 32 ? 2.0 : 0.0; }});
  EXPECT_EQ(m.mesh.indices.size(), 3u * 6);
}

TEST(AdaptiveMesh, ReportsTheErrorAtItsLimit) {
  const AdaptiveMesh m = adapted(bowl(), {}, {exact_error, 1e-9});
  const int cells = 16 << AdaptiveSurface::kMaxDepth;
  EXPECT_EQ(m.columns, cells);
  EXPECT_EQ(m.mesh.indices.size(), std::size_t{6} * static_cast<std::size_t>(cells * cells));
  // Half the error of triangles with a hypotenuse of two cells, which is measured with positions rounded to float.
  EXPECT_NEAR(m.error, 0.5 * std::pow(2.0 / cells, 2) / 4, 2e-7);
}

// Only what is near a point is fine.
TEST(AdaptiveMesh, IsFineOnlyWhereNeeded) {
  const glm::dvec3 eye(0.0, 0.0, 2.2);
  const ViewedError viewed{[&](const glm::dvec3& center, double radius, double error) {
                             return error / std::pow(std::max(0.1, glm::length(center - eye) - radius), 2);
                           },
                           0.02};
  const Mesh m = adapted(bumpy_ball(), kBall, viewed).mesh;
  std::size_t near = 0, far = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) ++(corner(m, i).position.z > 0 ? near : far);
  EXPECT_GT(near, 4 * far);
  expect_closed(m);
}

// If a view needs more squares than the limit, no square is divided at the depth that would exceed it.
TEST(AdaptiveMesh, StopsAtTheLimitOfSquares) {
  AdaptiveSurface surface(bowl(), {.columns = 32, .rows = 16});
  const AdaptiveMesh m = surface.mesh({exact_error, 0.0}, two_workers(), "test");
  EXPECT_EQ(m.columns, 32 * 16 * 4);  // 512 * (1 + 4 + 16) squares; 512 * 64 more would exceed 40,000
  EXPECT_GT(m.error, 0.0);
  EXPECT_EQ(surface.mesh({exact_error, 0.1}, two_workers(), "test").mesh.indices.size(), 3u * 2 * 512) << "after the limit";
}

void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.tangents, b.tangents);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.indices, b.indices);
}

TEST(AdaptiveMesh, DependsOnNeitherThreadsNorEarlierViews) {
  AdaptiveSurface used(bumpy_ball(), kBall);
  const ViewedError coarse{exact_error, 0.05}, fine{exact_error, 0.004};
  const Mesh one = used.mesh(coarse, Workers(1), "test").mesh;
  used.mesh(fine, Workers(1), "test");
  expect_equal(used.mesh(coarse, Workers(1), "test").mesh, one);
  expect_equal(AdaptiveSurface(bumpy_ball(), kBall).mesh(coarse, Workers(5), "test").mesh, one);
}

// The vertices of displaced_uv_sphere are points of SphereSurface.
TEST(SphereSurface, HasTheVerticesOfTheMesh) {
  const Mesh m = displaced_uv_sphere(8, 16, static_cast<float>(kBallSize), bumpy_field(), kBumpScale, kBumpZero, two_workers());
  for (std::size_t i = 16; i + 16 < m.positions.size(); ++i) {  // without the poles
    const SurfaceVertex v = bumpy_ball().at(static_cast<double>(m.uvs[i].x), static_cast<double>(m.uvs[i].y));
    EXPECT_EQ(v.position, m.positions[i]);
    EXPECT_EQ(v.normal, m.normals[i]);
    EXPECT_EQ(v.tangent, m.tangents[i]);
  }
  const Mesh smooth = uv_sphere(8, 16, 2.0f);
  const SphereSurface sphere(nullptr, 2.0, 0.0, 0.0);
  for (std::size_t i = 16; i + 16 < smooth.positions.size(); ++i)
    EXPECT_EQ(sphere.at(static_cast<double>(smooth.uvs[i].x), static_cast<double>(smooth.uvs[i].y)).position, smooth.positions[i]);
}

TEST(SphereSurface, PositionsAreThoseOfSinglePoints) {
  const std::array<double, 5> u{0.0, 0.1, 0.5, 0.77, 1.0};
  const std::array<double, 4> v{0.0, 0.3, 0.9, 1.0};
  const SphereSurface smooth(nullptr, 2.0, 0.0, 0.0);
  const SphereSurface tilted(&bumpy_field(), kBallSize, kBumpScale, kBumpZero, ReliefNormals::undisplaced);
  for (const SphereSurface* s : {&bumpy_ball(), &smooth, &tilted}) {
    std::array<glm::vec3, 20> positions;
    s->positions(u, v, positions);
    for (std::size_t j = 0; j < v.size(); ++j) {
      for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(positions[j * u.size() + i], s->at(u[i], v[j]).position);
    }
    for (const double w : v) EXPECT_EQ(s->at(0.0, w).position, s->at(1.0, w).position) << "seam";
  }
}

// The points of a surface at the texture coordinates of a mesh are the vertices of the mesh.
void expect_vertices(const PointSurface& surface, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const SurfaceVertex v = surface.at(static_cast<double>(mesh.uvs[i].x), static_cast<double>(mesh.uvs[i].y));
    EXPECT_EQ(v.position, mesh.positions[i]);
    EXPECT_EQ(v.normal, mesh.normals[i]);
    EXPECT_EQ(v.tangent, mesh.tangents[i]);
  }
}

TEST(PointSurface, HasTheVerticesOfTheMesh) {
  const HeightField tiled(rough_map(16, 8, 5), 0.7, two_workers(), MapEdges::torus);
  const HeightField sheet(rough_map(16, 8, 5), 0.7, two_workers(), MapEdges::sheet);
  const Displacement on_torus{&tiled, 0.05, 0.5}, on_sheet{&sheet, 0.05, 0.5};
  const auto ring = [](double u, double v) { return torus_point(1.0, 0.25, u, v); };
  const auto knot = [](double u, double v) { return torus_knot_point(1.0, 0.25, u, v); };
  const auto square = [](double u, double v) { return plane_point(2.0, u, v); };
  expect_vertices({ring, {}}, torus(1.0f, 0.25f, 8, 16));
  expect_vertices({ring, on_torus}, torus(1.0f, 0.25f, 8, 16, &on_torus));
  expect_vertices({knot, {}}, torus_knot(1.0f, 0.25f, 8, 64));
  expect_vertices({knot, on_torus}, torus_knot(1.0f, 0.25f, 8, 64, &on_torus));
  expect_vertices({square, {}}, plane(2.0f, 16));
  expect_vertices({square, on_sheet}, plane(2.0f, 16, &on_sheet));
}

TEST(AdaptiveMesh, KnotsAreClosed) {
  const HeightField tiled(rough_map(64, 8, 5), 0.7, two_workers(), MapEdges::torus);
  const PointSurface knot([](double u, double v) { return torus_knot_point(1.0, 0.2, u, v); }, Displacement{&tiled, 0.05, 0.5});
  const Mesh m = adapted(knot, {.columns = 96, .rows = 8, .closed_u = true, .closed_v = true}, {exact_error, 0.004}).mesh;
  expect_closed(m);
  expect_outward(m);
}

}  // namespace
}  // namespace halfspace
