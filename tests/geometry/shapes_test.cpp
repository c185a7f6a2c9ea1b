// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "geometry/mesh_checks.h"

namespace halfspace {
namespace {

class UvSphere : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(UvSphere, IsValidClosedAndFacesOutward) {
  const auto [latitudes, longitudes] = GetParam();
  const Mesh m = uv_sphere(latitudes, longitudes, 2.5f);
  EXPECT_EQ(m.indices.size(), static_cast<std::size_t>(6 * longitudes * (latitudes - 1)));
  expect_sound(m);
  expect_outward(m);
  expect_closed(m);
}

TEST_P(UvSphere, MatchesTheFormula) {
  const auto [latitudes, longitudes] = GetParam();
  const Mesh m = uv_sphere(latitudes, longitudes, 2.5f);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const double u = 2 * std::numbers::pi * static_cast<double>(m.uvs[i].x);
    const double v = std::numbers::pi * static_cast<double>(m.uvs[i].y);
    const glm::dvec3 n(std::sin(v) * std::cos(u), std::cos(v), -std::sin(v) * std::sin(u));
    // uvs are rounded to float, which moves the point given by the formula by up to 2π·2^-25.
    EXPECT_NEAR(glm::length(glm::dvec3(m.positions[i]) - 2.5 * n), 0, 2.5 * 4e-7);
    EXPECT_NEAR(glm::length(glm::dvec3(m.normals[i]) - n), 0, 4e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, UvSphere,
                         testing::Values(std::pair(2, 3), std::pair(3, 4), std::pair(16, 32), std::pair(37, 53), std::pair(180, 360)),
                         [](const auto& size) { return std::to_string(size.param.first) + "x" + std::to_string(size.param.second); });

TEST(UvSphereSeam, BothSidesHaveBitIdenticalPositions) {
  const Mesh m = uv_sphere(9, 13, 1.7f);
  std::map<float, Bits> west;  // by v
  int pairs = 0;
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (m.uvs[i].x == 0.0f) west[m.uvs[i].y] = bits_of(m.positions[i]);
  }
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (m.uvs[i].x != 1.0f) continue;
    EXPECT_EQ(bits_of(m.positions[i]), west.at(m.uvs[i].y));
    ++pairs;
  }
  EXPECT_EQ(pairs, 8);
}

TEST(UvSpherePoles, HaveOneVertexPerSectorAtItsCenter) {
  const int longitudes = 12;
  const Mesh m = uv_sphere(6, longitudes, 1.0f);
  for (const float pole : {0.0f, 1.0f}) {
    std::set<float> us;
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
      if (m.uvs[i].y != pole) continue;
      us.insert(m.uvs[i].x);
      EXPECT_EQ(m.positions[i], glm::vec3(0, 1 - 2 * pole, 0)) << "exactly on the axis";
    }
    EXPECT_EQ(us.size(), static_cast<std::size_t>(longitudes));
  }
  // A triangle at a pole spans its sector symmetrically, so the texture does not swirl.
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    std::array<glm::vec2, 3> uv = {corner(m, i).uv, corner(m, i + 1).uv, corner(m, i + 2).uv};
    for (std::size_t k = 0; k < 3; ++k) {
      if (uv[k].y != 0.0f && uv[k].y != 1.0f) continue;
      EXPECT_NEAR(uv[k].x, 0.5f * (uv[(k + 1) % 3].x + uv[(k + 2) % 3].x), 1e-6);
    }
  }
}

// The left edge of a map (180° W) is at +x; a quarter of the map's width further east is −z. Seen from outside with north up, east is to
// the right.
TEST(UvSphereEarth, IsNotMirrored) {
  const Mesh m = uv_sphere(4, 8, 1.0f);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (m.uvs[i] == glm::vec2(0, 0.5f)) {
      EXPECT_EQ(m.positions[i], glm::vec3(1, 0, 0));
    }
    if (m.uvs[i] == glm::vec2(0.25f, 0.5f)) {
      EXPECT_EQ(m.positions[i], glm::vec3(0, 0, -1));
    }
    if (m.uvs[i].y != 0.5f) continue;
    const glm::vec3 viewers_right = glm::cross(glm::vec3(0, 1, 0), m.normals[i]);
    EXPECT_GT(glm::dot(viewers_right, glm::vec3(m.tangents[i].x, m.tangents[i].y, m.tangents[i].z)), 0.99f);
  }
}

TEST(Cube, IsValidClosedAndFacesOutward) {
  const Mesh m = cube(3.0f);
  EXPECT_EQ(m.positions.size(), 24u);
  EXPECT_EQ(m.indices.size(), 36u);
  expect_sound(m);
  expect_outward(m);
  expect_closed(m);
  for (const glm::vec3& p : m.positions) EXPECT_EQ(glm::abs(p), glm::vec3(1.5f));
}

TEST(Plane, FacesUpAndItsTextureReadsFromAbove) {
  const Mesh m = plane(4.0f);
  expect_sound(m);
  expect_outward(m);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    EXPECT_EQ(m.normals[i], glm::vec3(0, 1, 0));
    EXPECT_EQ(m.positions[i], glm::vec3(4 * m.uvs[i].x - 2, 0, 4 * m.uvs[i].y - 2));
  }
}

// ---- tangents --------------------------------------------------------------------------------------------------

// On flat faces the position is linear in (u, v), so a triangle has the same ∂P/∂u and ∂P/∂v as its face, except for the rounding of
// positions and coordinates to float (about 1e-7 of an edge).
void expect_tangents_of_flat_faces(const Mesh& m) {
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const Corner a = corner(m, i), b = corner(m, i + 1), c = corner(m, i + 2);
    const glm::dvec3 p(b.position - a.position), q(c.position - a.position);
    const glm::dvec2 e(b.uv - a.uv), f(c.uv - a.uv);
    const double area = e.x * f.y - e.y * f.x;
    const glm::dvec3 along_u = glm::normalize((p * f.y - q * e.y) / area), along_v = glm::normalize((q * e.x - p * f.x) / area);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(glm::length(tangent_of(m, m.indices[i + k]) - along_u), 1e-6);
      EXPECT_LT(glm::length(bitangent_of(m, m.indices[i + k]) + along_v), 1e-6);
    }
  }
}

TEST(Tangents, FollowTheTextureCoordinatesOnFlatFaces) {
  expect_tangents_of_flat_faces(plane(4.0f));
  expect_tangents_of_flat_faces(cube(3.0f));
}

// Central differences with h = 1e-6 have errors of (2πh)²/6 and 1e-16/h, and vertices are rounded to float. ∂P/∂u is zero at the poles, so
// a pole vertex has the tangent of its longitude, which is a unit vector (see IsValidClosedAndFacesOutward).
TEST(Tangents, FollowTheTextureCoordinatesOnUvSpheres) {
  const Mesh m = uv_sphere(12, 24, 2.0f);
  const auto sphere = [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * v;
    return 2.0 * glm::dvec3(std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a));
  };
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const double u = static_cast<double>(m.uvs[i].x), v = static_cast<double>(m.uvs[i].y), h = 1e-6;
    if (v != 0.0 && v != 1.0) {
      EXPECT_LT(glm::length(tangent_of(m, i) - glm::normalize(sphere(u + h, v) - sphere(u - h, v))), 1e-6);
    }
    EXPECT_LT(glm::length(bitangent_of(m, i) + glm::normalize(sphere(u, v + h) - sphere(u, v - h))), 1e-6);
  }
}

TEST(Shapes, BrokenPreconditionsAbort) {
  EXPECT_DEATH(uv_sphere(1, 8, 1), "too few latitudes");
  EXPECT_DEATH(uv_sphere(8, 2, 1), "too few longitudes");
  EXPECT_DEATH(uv_sphere(8, 8, 0), "radius is not positive");
}

}  // namespace
}  // namespace halfspace
