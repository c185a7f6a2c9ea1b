// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <set>

namespace halfspace {
namespace {

using Corners = std::vector<glm::dvec3>;

std::vector<uint32_t> triangles_of(const Corners& corners) {
  std::vector<uint32_t> triangles;
  triangulate(corners, triangles);
  return triangles;
}

// Twice the area, for polygons with z = 0. Exact for integer coordinates.
double doubled_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double doubled_area(const Corners& corners) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) area += doubled_area(corners[0], corners[i], corners[i + 1]);
  return area;
}

// Checks that all triangles are counter-clockwise and that their total area is that of a simple counter-clockwise polygon. They then cover
// it exactly once.
void expect_exact_cover(const Corners& corners) {
  const std::vector<uint32_t> triangles = triangles_of(corners);
  ASSERT_EQ(triangles.size(), 3 * (corners.size() - 2));
  double area = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const double part = doubled_area(corners[triangles[i]], corners[triangles[i + 1]], corners[triangles[i + 2]]);
    EXPECT_GE(part, 0.0) << "triangle " << i / 3 << " has the wrong winding";
    area += part;
  }
  EXPECT_EQ(area, doubled_area(corners));
}

// Whether two vertices of a quad are connected by the diagonal.
bool is_cut_at(const std::vector<uint32_t>& triangles, uint32_t corner) {
  return std::ranges::count(triangles, corner) == 2 && std::ranges::count(triangles, (corner + 2) % 4) == 2;
}

Corners comb(int teeth) {
  Corners corners{{0, 0, 0}, {2 * teeth, 0, 0}};
  for (int i = teeth; i > 0; --i) {
    corners.emplace_back(2 * i - 1, 10, 0);
    corners.emplace_back(2 * i - 2, 1, 0);
  }
  return corners;
}

Corners spiral(int turns) {
  Corners corners;
  for (int i = 0; i < 4 * turns; ++i) {
    const double r = 10 + 5 * i;
    corners.emplace_back(glm::dvec3(i % 4 == 0 || i % 4 == 3 ? r : -r, i % 4 < 2 ? r : -r, 0));
  }
  for (int i = 4 * turns - 1; i >= 0; --i) {
    const double r = 8 + 5 * i;
    corners.emplace_back(glm::dvec3(i % 4 == 0 || i % 4 == 3 ? r : -r, i % 4 < 2 ? r : -r, 0));
  }
  return doubled_area(corners) > 0.0 ? corners : Corners(corners.rbegin(), corners.rend());
}

TEST(Triangulate, KeepsTriangles) { EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<uint32_t>{0, 1, 2})); }

TEST(Triangulate, AppendsToTheList) {
  std::vector<uint32_t> triangles{7};
  triangulate(Corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
  EXPECT_EQ(triangles, (std::vector<uint32_t>{7, 0, 1, 2}));
}

TEST(Triangulate, CutsConvexQuadsAlongTheShorterDiagonal) {
  EXPECT_TRUE(is_cut_at(triangles_of({{0, 0, 0}, {9, 0, 0}, {10, 10, 0}, {0, 2, 0}}), 1));
  EXPECT_TRUE(is_cut_at(triangles_of({{0, 2, 0}, {0, 0, 0}, {9, 0, 0}, {10, 10, 0}}), 0));
  EXPECT_TRUE(is_cut_at(triangles_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 0));
}

// The shorter diagonal of this quad is outside it.
TEST(Triangulate, CutsConcaveQuadsAtTheReflexVertex) {
  const Corners quad{{0, 0, 0}, {4, 1, 0}, {0, 2, 0}, {1, 1, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t turn = 0; turn < 4; ++turn) {
      for (const bool reversed : {false, true}) {
        Corners corners;
        for (uint32_t i = 0; i < 4; ++i) {
          const glm::dvec3& p = quad[(reversed ? 3 - i + turn : i + turn) % 4];
          corners.push_back(axis == 0 ? p : axis == 1 ? glm::dvec3(p.y, p.z, p.x) : glm::dvec3(p.z, p.x, p.y));
        }
        const auto reflex = static_cast<uint32_t>(std::ranges::find_if(corners,
                                                                       [](auto& p) {
                                                                         return std::max({p.x, p.y, p.z}) == 1.0;
                                                                       }) -
                                                  corners.begin());
        const std::vector<uint32_t> triangles = triangles_of(corners);
        EXPECT_TRUE(is_cut_at(triangles, reflex)) << axis << turn << reversed;
        for (std::size_t i = 0; i < 6; i += 3) {  // the winding is that of the quad
          const glm::dvec3 a = corners[triangles[i]], b = corners[triangles[i + 1]], c = corners[triangles[i + 2]];
          const glm::dvec3 normal = glm::cross(b - a, c - a);
          EXPECT_GT((normal.x + normal.y + normal.z) * (reversed ? -1.0 : 1.0), 0.0) << axis << turn << reversed;
        }
      }
    }
  }
}

// One vertex is 2^-53 away from the line through two others. After rounding, the coordinate differences would be on the line.
TEST(Triangulate, ComputesOrientationsExactly) {
  for (const int side : {-1, 0, 1}) {
    const Corners quad{{0.5 + side * 0x1p-53, 0.5, 0}, {12, 12, 0}, {24, 24, 0}, {-30, 60, 0}};
    EXPECT_TRUE(is_cut_at(triangles_of(quad), side < 0 ? 0 : 1)) << side;
  }
}

TEST(Triangulate, CoversConcavePolygonsExactly) {
  expect_exact_cover({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});                            // L
  expect_exact_cover({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}, {0, 4, 0}, {0, 2, 0}});      // collinear vertices
  expect_exact_cover({{0, 0, 0}, {5, 4, 0}, {10, 0, 0}, {6, 5, 0}, {10, 10, 0}, {5, 6, 0}, {0, 10, 0}, {4, 5, 0}});  // star
  expect_exact_cover(comb(50));
  expect_exact_cover(spiral(6));
}

TEST(Triangulate, CoversPolygonsWithBridgedHoles) {
  expect_exact_cover({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}});
}

TEST(Triangulate, CoversRandomPolygonsExactly) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const auto count = 25 + random() % 200;  // enough vertices that the polygon contains the origin
    std::set<double> angles;
    while (angles.size() < count) angles.insert(static_cast<double>(random()) * 0x1p-32 * 6.28);
    Corners corners;
    for (const double angle : angles) {
      const double r = 1e5 + static_cast<double>(random() % 1000000);
      corners.emplace_back(std::round(r * std::cos(angle)), std::round(r * std::sin(angle)), 0);
    }
    expect_exact_cover(corners);
  }
}

TEST(Triangulate, CoversLargePolygonsFast) {
  const auto start = std::chrono::steady_clock::now();
  expect_exact_cover(comb(100000));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Triangulate, TerminatesForPolygonsThatAreNotSimple) {
  std::mt19937 random(3);
  Corners knot(100000);
  for (glm::dvec3& p : knot) p = {random() % 1000, random() % 1000, random() % 1000};
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(triangles_of(knot).size(), 3 * (knot.size() - 2));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(triangles_of(Corners(100, glm::dvec3(1.0))).size(), 3 * 98u);
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size(), 9u);
  EXPECT_EQ(triangles_of({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}).size(), 6u);
  EXPECT_TRUE(triangles_of({{0, 0, 0}, {2, 2, 0}}).empty());
}

// Far from the origin, in a plane that is not parallel to an axis.
TEST(Triangulate, IgnoresTheDistanceFromTheOrigin) {
  const glm::dvec3 far(5e6, -5e6, 5e6);
  const Corners near{{0, 0, 0}, {4, 1, 1}, {0, 2, 0}, {3, 1, 0.75}, {2, 1, 0.5}};
  Corners moved;
  for (const glm::dvec3& p : near) moved.push_back(p + far);
  EXPECT_EQ(triangles_of(near), triangles_of(moved));
}

}  // namespace
}  // namespace halfspace
