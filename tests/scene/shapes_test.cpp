// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <string>

namespace halfspace {
namespace {

using Bits = std::array<uint32_t, 3>;

Bits bits_of(const glm::vec3& p) {
  Bits b;
  std::memcpy(b.data(), &p, sizeof b);
  return b;
}

struct Corner {
  glm::vec3 position, normal, tangent;
  glm::vec2 uv;
};

Corner corner(const Mesh& m, std::size_t i) {
  const uint32_t v = m.indices[i];
  return {m.positions[v], m.normals[v], glm::vec3(m.tangents[v].x, m.tangents[v].y, m.tangents[v].z), m.uvs[v]};
}

void expect_sound(const Mesh& m) {
  ASSERT_EQ(m.normals.size(), m.positions.size());
  ASSERT_EQ(m.tangents.size(), m.positions.size());
  ASSERT_EQ(m.uvs.size(), m.positions.size());
  ASSERT_EQ(m.indices.size() % 3, 0u);
  std::set<uint32_t> used(m.indices.begin(), m.indices.end());
  EXPECT_EQ(used.size(), m.positions.size()) << "no vertex is unused";
  EXPECT_LT(*used.rbegin(), m.positions.size());
  for (std::size_t v = 0; v < m.positions.size(); ++v) {
    EXPECT_NEAR(glm::length(m.normals[v]), 1, 1e-6);
    const glm::vec3 t(m.tangents[v].x, m.tangents[v].y, m.tangents[v].z);
    EXPECT_NEAR(glm::length(t), 1, 1e-6);
    EXPECT_NEAR(glm::dot(t, m.normals[v]), 0, 1e-6);
    EXPECT_EQ(m.tangents[v].w, 1.0f);
  }
}

// Seen from outside, every triangle is counter-clockwise and has an area; the texture is not mirrored on it, and its
// tangent points along u, cross(normal, tangent) along −v.
void expect_outward(const Mesh& m) {
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const Corner a = corner(m, i), b = corner(m, i + 1), c = corner(m, i + 2);
    const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
    EXPECT_GT(glm::dot(face, face), 0.0f) << "triangle " << i / 3 << " is degenerate";
    EXPECT_GT(glm::dot(face, a.normal + b.normal + c.normal), 0.0f) << "triangle " << i / 3 << " faces inwards";
    // t grows downwards in the picture, so a counter-clockwise triangle is clockwise in (u, t).
    const glm::vec2 e = b.uv - a.uv, f = c.uv - a.uv;
    const float uv_area = e.x * f.y - e.y * f.x;
    EXPECT_LT(uv_area, 0.0f) << "triangle " << i / 3 << " shows its texture mirrored";
    const glm::vec3 along_u = ((b.position - a.position) * f.y - (c.position - a.position) * e.y) / uv_area;
    const glm::vec3 along_v = ((c.position - a.position) * e.x - (b.position - a.position) * f.x) / uv_area;
    EXPECT_GT(glm::dot(along_u, a.tangent + b.tangent + c.tangent), 0.0f);
    EXPECT_LT(glm::dot(along_v, glm::cross(a.normal, a.tangent)), 0.0f);
  }
}

// By position (bit for bit), every edge is used once in each direction: closed, and wound alike everywhere.
void expect_closed(const Mesh& m) {
  std::map<std::pair<Bits, Bits>, int> edges;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{bits_of(corner(m, i + k).position), bits_of(corner(m, i + (k + 1) % 3).position)}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

class UvSphere : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(UvSphere, IsSoundClosedAndOutward) {
  const auto [latitudes, longitudes] = GetParam();
  const Mesh m = uv_sphere(latitudes, longitudes, 2.5f);
  EXPECT_EQ(m.indices.size(), static_cast<std::size_t>(6 * longitudes * (latitudes - 1)));
  expect_sound(m);
  expect_outward(m);
  expect_closed(m);
}

TEST_P(UvSphere, IsTheFormula) {
  const auto [latitudes, longitudes] = GetParam();
  const Mesh m = uv_sphere(latitudes, longitudes, 2.5f);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const double u = 2 * std::numbers::pi * static_cast<double>(m.uvs[i].x);
    const double v = std::numbers::pi * static_cast<double>(m.uvs[i].y);
    const glm::dvec3 n(std::sin(v) * std::cos(u), std::cos(v), -std::sin(v) * std::sin(u));
    // uvs are rounded to float, which moves the formula's point by up to 2π·2^-25.
    EXPECT_NEAR(glm::length(glm::dvec3(m.positions[i]) - 2.5 * n), 0, 2.5 * 4e-7);
    EXPECT_NEAR(glm::length(glm::dvec3(m.normals[i]) - n), 0, 4e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, UvSphere,
                         testing::Values(std::pair(2, 3), std::pair(3, 4), std::pair(16, 32), std::pair(37, 53), std::pair(180, 360)),
                         [](const auto& size) { return std::to_string(size.param.first) + "x" + std::to_string(size.param.second); });

TEST(UvSphereSeam, BothSidesHaveTheSamePositionBits) {
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

TEST(UvSpherePoles, OneVertexPerSectorAtItsMiddle) {
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
  // A triangle at a pole spans its sector symmetrically: no swirl.
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    std::array<glm::vec2, 3> uv = {corner(m, i).uv, corner(m, i + 1).uv, corner(m, i + 2).uv};
    for (std::size_t k = 0; k < 3; ++k) {
      if (uv[k].y != 0.0f && uv[k].y != 1.0f) continue;
      EXPECT_NEAR(uv[k].x, 0.5f * (uv[(k + 1) % 3].x + uv[(k + 2) % 3].x), 1e-6);
    }
  }
}

// The left edge of a map is 180° W at +x; a quarter of the map further east is −z. Seen from outside with north up,
// east lies to the right.
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

TEST(Cube, IsSoundClosedAndOutward) {
  const Mesh m = cube(3.0f);
  EXPECT_EQ(m.positions.size(), 24u);
  EXPECT_EQ(m.indices.size(), 36u);
  expect_sound(m);
  expect_outward(m);
  expect_closed(m);
  for (const glm::vec3& p : m.positions) EXPECT_EQ(glm::abs(p), glm::vec3(1.5f));
}

TEST(Plane, FacesUpWithItsTextureReadFromAbove) {
  const Mesh m = plane(4.0f);
  expect_sound(m);
  expect_outward(m);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    EXPECT_EQ(m.normals[i], glm::vec3(0, 1, 0));
    EXPECT_EQ(m.positions[i], glm::vec3(4 * m.uvs[i].x - 2, 0, 4 * m.uvs[i].y - 2));
  }
}

TEST(Shapes, BrokenPreconditionsAbort) {
  EXPECT_DEATH(uv_sphere(1, 8, 1), "latitudes >= 2");
  EXPECT_DEATH(uv_sphere(8, 2, 1), "longitudes >= 3");
  EXPECT_DEATH(uv_sphere(8, 8, 0), "radius > 0.0f");
}

}  // namespace
}  // namespace halfspace
