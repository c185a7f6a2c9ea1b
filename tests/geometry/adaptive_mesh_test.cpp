// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/adaptive_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh_checks.h"
#include "geometry/rough_map.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr PatchGrid kBall{.columns = 8, .rows = 4, .closed_u = true, .closed_v = false};
constexpr double kBallSize = 2.0, kBumpScale = 0.3, kBumpZero = 0.5;

const HeightField& bumpy_field() {
  static const HeightField field(rough_map(32, 16, 7), 0.7, two_workers());
  return field;
}

const DisplacedSphere& bumpy_ball() {
  static const DisplacedSphere sphere(bumpy_field(), kBallSize, kBumpScale, kBumpZero);
  return sphere;
}

// A height over the unit square.
class Sheet : public ParametricSurface {
 public:
  explicit Sheet(double (*height)(double, double)) : height_(height) {}
  SurfaceVertex at(double u, double v) const override { return {glm::vec3(glm::dvec3(u, -v, height_(u, v))), {0, 0, 1}, {1, 0, 0, 1}}; }

 private:
  double (*height_)(double, double);
};

// A ring around the z axis, closed along u and v.
class Ring : public ParametricSurface {
 public:
  SurfaceVertex at(double u, double v) const override {
    const SinCosDouble a = sincos_turns(u), b = sincos_turns(v);
    const double r = 2.0 - 0.5 * b.cos;
    return {glm::vec3(glm::dvec3(r * a.cos, 0.5 * b.sin, -r * a.sin) + 0.0), {0, 1, 0}, {1, 0, 0, 1}};
  }
};

using Patches = std::vector<std::shared_ptr<const PatchErrors>>;

Patches patches_of(const ParametricSurface& s, const PatchGrid& grid, const std::function<int(int)>& level) {
  Patches out;
  for (int p = 0; p < grid.patches(); ++p) out.push_back(std::make_shared<const PatchErrors>(s, grid, p, level(p)));
  return out;
}

Mesh mesh_of(const ParametricSurface& s, const PatchGrid& grid, int level, const SplitTest& test) {
  return adaptive_mesh(s, grid, patches_of(s, grid, [&](int) { return level; }), test, two_workers());
}

SplitTest errors_above(double allowed) {
  return [=](const glm::dvec3&, double, double error) { return error > allowed; };
}

// A test that decides by the bits of the center, as if at random.
SplitTest random_splits(uint32_t seed, uint32_t of_eight) {
  return [=](const glm::dvec3& center, double, double) {
    uint32_t hash = seed;
    for (int k = 0; k < 3; ++k) hash = (hash ^ static_cast<uint32_t>(static_cast<int>(center[k] * 65536.0))) * 2654435761u;
    return hash >> 29 < of_eight;
  };
}

TEST(AdaptiveMesh, FlatPatchesStayWhole) {
  const Sheet sheet([](double, double) { return 0.0; });
  const Mesh m = mesh_of(sheet, {.columns = 3, .rows = 2}, 4, errors_above(1e-6));
  EXPECT_EQ(m.indices.size(), 3u * 2 * 6);
  EXPECT_EQ(m.positions.size(), 4u * 6);
}

TEST(AdaptiveMesh, SplittingEverythingGivesTheWholeGrid) {
  const Sheet sheet([](double, double) { return 0.0; });
  const Mesh m = mesh_of(sheet, {.columns = 3, .rows = 2}, 4, [](const glm::dvec3&, double, double) { return true; });
  EXPECT_EQ(m.indices.size(), 3u * 2 * 6 * 16 * 16);
}

// A paraboloid: the middle of a hypotenuse (du, dv) is (du² + dv²)/4 below its chord, and this is the largest deviation in the triangle. In
// a triangle with legs h, the hypotenuse is √2 h long.
TEST(AdaptiveMesh, ErrorsOfAParaboloidAreItsChordErrors) {
  const Sheet bowl([](double u, double v) { return u * u + v * v; });
  const PatchErrors patch(bowl, {}, 0, 5);
  for (int s = 0; s < 5; ++s) {
    const int h = 1 << s;
    const double squared = std::pow(h / 32.0, 2);
    // The tolerance is for positions rounded to float: 2^-24 of at most 2, three times.
    EXPECT_NEAR(static_cast<double>(patch.error({h, h})), 2 * 4 * squared / 4, 4e-7) << "center of a square, step " << h;
    EXPECT_NEAR(static_cast<double>(patch.error({h, 2 * h})), 4 * squared / 4, 4e-7) << "middle of a side, step " << h;
  }
  EXPECT_NEAR(static_cast<double>(patch.finest_error()), 2 * 4 * std::pow(1 / 32.0, 2) / 4, 4e-7);
}

// Only one vertex is high. Every triangle around it has its error.
TEST(AdaptiveMesh, EveryVertexOfTheGridCounts) {
  const Sheet spike([](double u, double v) { return u == 5.0 / 32 && v == 11.0 / 32 ? 1.0 : 0.0; });
  const PatchErrors patch(spike, {}, 0, 5);
  const GridVertex spiked{5, 11};
  const auto side = [spiked](GridVertex a, GridVertex b) { return (b.i - a.i) * (spiked.j - a.j) - (b.j - a.j) * (spiked.i - a.i); };
  int around = 0;
  const std::function<void(const GridTriangle&)> check = [&](const GridTriangle& t) {
    if (!t.can_split() || t.apex == spiked || t.b == spiked || t.c == spiked) return;
    if (side(t.apex, t.b) > 0 || side(t.b, t.c) > 0 || side(t.c, t.apex) > 0) return;  // counter-clockwise if v points down
    EXPECT_GE(patch.error(t.split()), 1.0f);
    ++around;
    check(t.first());
    check(t.second());
  };
  for (const int half : {0, 1}) check(patch_half(half, 32));
  EXPECT_GE(around, 8);
  EXPECT_EQ(patch.error({28, 28}), 0.0f);
}

TEST(AdaptiveMesh, HasNoCracksForAnyChoice) {
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    // Patches at different levels; 6 of 8 triangles are bisected, so that some branches end at each depth.
    const auto level = [&](int p) { return 2 + static_cast<int>((static_cast<uint32_t>(p) * 2654435761u * seed) >> 30); };
    const Mesh sphere = adaptive_mesh(bumpy_ball(), kBall, patches_of(bumpy_ball(), kBall, level), random_splits(seed, 6), two_workers());
    expect_closed(sphere);
    const PatchGrid grid{.columns = 5, .rows = 3, .closed_u = true, .closed_v = true};
    const Mesh ring = adaptive_mesh(Ring(), grid, patches_of(Ring(), grid, level), random_splits(seed, 6), two_workers());
    expect_closed(ring);
  }
}

TEST(AdaptiveMesh, TrianglesFaceOutward) { expect_outward(mesh_of(bumpy_ball(), kBall, 5, errors_above(0.01))); }

// The error of a triangle is measured at the vertices of the grid. Between them, the surface deviates by at most its own chord error in
// a cell, a quarter of the error of triangles with two cells.
TEST(AdaptiveMesh, NoPointIsOffByMoreThanTheAllowedError) {
  const Patches patches = patches_of(bumpy_ball(), kBall, [](int) { return 6; });
  double cell = 0.0;
  for (const auto& p : patches) cell = std::max(cell, 0.25 * static_cast<double>(p->finest_error()));
  for (const double allowed : {0.1, 0.02, 0.005}) {
    const Mesh m = adaptive_mesh(bumpy_ball(), kBall, patches, errors_above(allowed), two_workers());
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
    EXPECT_LE(largest, allowed + cell);
    EXPECT_GE(largest, 0.5 * allowed) << "the mesh is finer than necessary";
    EXPECT_LT(m.indices.size() / 3, 2u * 32 * 64 * 64 / 4) << "the whole grid has four times as many triangles at least";
  }
}

// Only what is near a point is fine.
TEST(AdaptiveMesh, IsFineOnlyWhereNeeded) {
  const glm::dvec3 eye(0.0, 0.0, 2.2);
  const Mesh m = mesh_of(bumpy_ball(), kBall, 6, [&](const glm::dvec3& center, double radius, double error) {
    return error > 0.02 * std::pow(std::max(0.1, glm::length(center - eye) - radius), 2);
  });
  std::size_t near = 0, far = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) ++(corner(m, i).position.z > 0 ? near : far);
  EXPECT_GT(near, 4 * far);
  expect_closed(m);
}

TEST(AdaptiveMesh, IsTheSameForAnyNumberOfThreads) {
  const Patches patches = patches_of(bumpy_ball(), kBall, [](int p) { return 3 + p % 3; });
  const Mesh one = adaptive_mesh(bumpy_ball(), kBall, patches, errors_above(0.01), Workers(1));
  const Mesh five = adaptive_mesh(bumpy_ball(), kBall, patches, errors_above(0.01), Workers(5));
  EXPECT_EQ(one.positions, five.positions);
  EXPECT_EQ(one.normals, five.normals);
  EXPECT_EQ(one.uvs, five.uvs);
  EXPECT_EQ(one.indices, five.indices);
}

// The vertices of displaced_uv_sphere are points of DisplacedSphere.
TEST(AdaptiveMesh, ADisplacedSphereHasTheVerticesOfItsMesh) {
  const Mesh m = displaced_uv_sphere(8, 16, static_cast<float>(kBallSize), bumpy_field(), kBumpScale, kBumpZero, two_workers());
  for (std::size_t i = 16; i + 16 < m.positions.size(); ++i) {  // without the poles
    const SurfaceVertex v = bumpy_ball().at(static_cast<double>(m.uvs[i].x), static_cast<double>(m.uvs[i].y));
    EXPECT_EQ(v.position, m.positions[i]);
    EXPECT_EQ(v.normal, m.normals[i]);
    EXPECT_EQ(v.tangent, m.tangents[i]);
  }
}

}  // namespace
}  // namespace halfspace
