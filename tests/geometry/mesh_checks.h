// SPDX-License-Identifier: Apache-2.0
//
// Checks that every generated mesh must pass.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "halfspace/geometry/mesh.h"

namespace halfspace {

using Bits = std::array<uint32_t, 3>;

inline Bits bits_of(const glm::vec3& p) {
  Bits b;
  std::memcpy(b.data(), &p, sizeof b);
  return b;
}

struct Corner {
  glm::vec3 position, normal, tangent;
  glm::vec2 uv;
};

inline Corner corner(const Mesh& m, std::size_t i) {
  const uint32_t v = m.indices[i];
  return {m.positions[v], m.normals[v], glm::vec3(m.tangents[v].x, m.tangents[v].y, m.tangents[v].z), m.uvs[v]};
}

inline void expect_sound(const Mesh& m) {
  ASSERT_EQ(m.normals.size(), m.positions.size());
  ASSERT_EQ(m.tangents.size(), m.positions.size());
  ASSERT_EQ(m.uvs.size(), m.positions.size());
  ASSERT_EQ(m.indices.size() % 3, 0u);
  std::set<uint32_t> used(m.indices.begin(), m.indices.end());
  EXPECT_EQ(used.size(), m.positions.size()) << "a vertex is unused";
  EXPECT_LT(*used.rbegin(), m.positions.size());
  for (std::size_t v = 0; v < m.positions.size(); ++v) {
    EXPECT_NEAR(glm::length(m.normals[v]), 1, 1e-6);
    const glm::vec3 t(m.tangents[v].x, m.tangents[v].y, m.tangents[v].z);
    EXPECT_NEAR(glm::length(t), 1, 1e-6);
    EXPECT_NEAR(glm::dot(t, m.normals[v]), 0, 1e-6);
    EXPECT_EQ(m.tangents[v].w, 1.0f);
  }
}

// Checks that every triangle is counter-clockwise when seen from outside and has a nonzero area, that its texture is not mirrored, that its
// tangent points along u, and that cross(normal, tangent) points along −v.
inline void expect_outward(const Mesh& m) {
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const Corner a = corner(m, i), b = corner(m, i + 1), c = corner(m, i + 2);
    const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
    EXPECT_GT(glm::dot(face, face), 0.0f) << "triangle " << i / 3 << " is degenerate";
    EXPECT_GT(glm::dot(face, a.normal + b.normal + c.normal), 0.0f) << "triangle " << i / 3 << " faces inward";
    // t increases downwards in the image, so a counter-clockwise triangle is clockwise in (u, t).
    const glm::vec2 e = b.uv - a.uv, f = c.uv - a.uv;
    const float uv_area = e.x * f.y - e.y * f.x;
    EXPECT_LT(uv_area, 0.0f) << "triangle " << i / 3 << " has a mirrored texture";
    const glm::vec3 along_u = ((b.position - a.position) * f.y - (c.position - a.position) * e.y) / uv_area;
    const glm::vec3 along_v = ((c.position - a.position) * e.x - (b.position - a.position) * f.x) / uv_area;
    EXPECT_GT(glm::dot(along_u, a.tangent + b.tangent + c.tangent), 0.0f);
    EXPECT_LT(glm::dot(along_v, glm::cross(a.normal, a.tangent)), 0.0f);
  }
}

// Checks that every edge, identified by the bits of its positions, occurs once in each direction. The mesh is then closed and consistently
// wound.
inline void expect_closed(const Mesh& m) {
  std::map<std::pair<Bits, Bits>, int> edges;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{bits_of(corner(m, i + k).position), bits_of(corner(m, i + (k + 1) % 3).position)}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

inline glm::dvec3 tangent_of(const Mesh& m, std::size_t i) { return {m.tangents[i].x, m.tangents[i].y, m.tangents[i].z}; }

// Returns the direction in which the green channel of a normal map tilts the normal.
inline glm::dvec3 bitangent_of(const Mesh& m, std::size_t i) {
  return static_cast<double>(m.tangents[i].w) * glm::cross(glm::dvec3(m.normals[i]), tangent_of(m, i));
}

}  // namespace halfspace
