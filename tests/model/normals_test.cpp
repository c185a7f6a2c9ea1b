// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "model/test_meshes.h"

namespace halfspace {
namespace {

double length_of(const glm::vec3& v) { return std::sqrt(glm::dot(glm::dvec3(v), glm::dvec3(v))); }

/// Returns the largest distance between the normal of a vertex and its normalized position.
double max_error_on_sphere(const ModelMesh& mesh) {
  double error = 0.0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 exact = mesh.positions[i] / static_cast<float>(length_of(mesh.positions[i]));
    error = std::max(error, length_of(mesh.normals[i] - exact));
  }
  return error;
}

TEST(Normals, SplitCubeAtItsEdgesBelowTheAngleOfItsFaces) {
  ModelMesh mesh = cube();
  add_smooth_normals(mesh, 30.0f);
  ASSERT_EQ(mesh.positions.size(), 24u);
  ASSERT_EQ(mesh.normals.size(), 24u);
  for (const uint32_t i : mesh.indices) {
    const glm::vec3 n = mesh.normals[i];
    EXPECT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1.0f);
    EXPECT_GT(glm::dot(n, mesh.positions[i]), 0.0f) << "the normal points inward";
  }
}

TEST(Normals, JoinCubeFacesAtAndAboveTheirAngle) {
  for (const float crease : {90.0f, 180.0f}) {
    ModelMesh mesh = cube();
    add_smooth_normals(mesh, crease);
    ASSERT_EQ(mesh.positions.size(), 8u);
    // The normals are weighted by angle, so the diagonals of the faces make no difference.
    for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(length_of(mesh.normals[i] - mesh.positions[i] / std::sqrt(3.0f)), 2e-7);
  }
}

TEST(Normals, OfSpheresAreCloseToTheExactOnes) {
  ModelMesh coarse = sphere(24, 12), fine = sphere(48, 24);
  add_smooth_normals(coarse, 60.0f);
  add_smooth_normals(fine, 60.0f);
  const double coarse_error = max_error_on_sphere(coarse), fine_error = max_error_on_sphere(fine);
  EXPECT_LT(coarse_error, 0.012);
  EXPECT_LT(fine_error, 0.003);  // the error is proportional to the square of the edge length
  EXPECT_EQ(fine.positions.size(), sphere(48, 24).positions.size()) << "a vertex was split";
  for (const glm::vec3& n : fine.normals) EXPECT_NEAR(length_of(n), 1.0, 1e-7);
}

TEST(Normals, DoNotDependOnTheSizeOfTheMesh) {
  ModelMesh unit = sphere(24, 12);
  add_smooth_normals(unit, 30.0f);
  for (const float scale : {0x1p-60f, 0x1p60f}) {
    ModelMesh mesh = sphere(24, 12);
    for (glm::vec3& p : mesh.positions) p *= scale;
    add_smooth_normals(mesh, 30.0f);
    EXPECT_TRUE(mesh.normals == unit.normals) << scale;
  }
}

TEST(Normals, JoinVerticesWithEqualPositions) {
  ModelMesh mesh = sphere(24, 12), joined = mesh;
  std::vector<glm::vec3> corners;
  for (const uint32_t i : mesh.indices) corners.push_back(mesh.positions[i]);
  mesh.positions = corners;
  for (uint32_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = i;
  add_smooth_normals(mesh, 180.0f);
  add_smooth_normals(joined, 180.0f);
  ASSERT_EQ(mesh.normals.size(), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(mesh.normals[i], joined.normals[joined.indices[i]]);
}

TEST(Normals, TreatNegativeZeroAsZero) {
  ModelMesh mesh;
  mesh.positions = {{-1, 0, 0}, {0.0f, 0, 0}, {0, 0, -1}, {1, 0.5f, 0}, {-0.0f, 0, 0}, {0, 0, -1}};
  mesh.indices = {0, 1, 2, 3, 5, 4};
  add_smooth_normals(mesh, 60.0f);
  EXPECT_EQ(mesh.normals[1], mesh.normals[4]);
}

TEST(Normals, FollowSmoothingGroups) {
  // Edges between faces of the same group are smooth, even at the right angles of the cube. Triangles of group 0 are flat.
  std::vector<uint32_t> groups(12, 0);
  groups[0] = groups[1] = groups[2] = groups[3] = 1;  // the first two faces, which are opposite
  groups[4] = groups[5] = 1;                          // a face that touches both
  ModelMesh mesh = cube();
  add_smooth_normals(mesh, 30.0f, groups);
  std::map<uint32_t, std::set<std::tuple<float, float, float>>> normals_of_triangle;
  for (uint32_t i = 0; i < mesh.indices.size(); ++i) {
    const glm::vec3 n = mesh.normals[mesh.indices[i]];
    normals_of_triangle[i / 3].insert({n.x, n.y, n.z});
  }
  for (const uint32_t flat : {6u, 7u, 8u, 9u, 10u, 11u}) EXPECT_EQ(normals_of_triangle[flat].size(), 1u) << flat;
  EXPECT_EQ(normals_of_triangle[4].size(), 2u);  // one normal along each of the two edges where the smooth faces meet
}

TEST(Normals, OfDegenerateTrianglesAreDefined) {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {5, 5, 5}};
  mesh.indices = {0, 1, 2, 0, 3, 1, 2, 2, 2};
  ModelMesh flat = mesh;
  add_smooth_normals(mesh, 30.0f);
  add_flat_normals(flat);
  EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(5, glm::vec3(0, 1, 0)));
  EXPECT_EQ(flat.normals, std::vector<glm::vec3>(9, glm::vec3(0, 1, 0)));
}

TEST(Normals, TrianglesBackToBackHaveOppositeNormals) {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 1};
  add_smooth_normals(mesh, 30.0f);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.normals[mesh.indices[0]], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[mesh.indices[3]], glm::vec3(0, 0, -1));
}

TEST(Normals, KeepTheDataOfSplitVertices) {
  ModelMesh mesh = cube();
  for (std::size_t i = 0; i < 8; ++i) {
    mesh.uvs[1].emplace_back(static_cast<float>(i), 0.5f);
    mesh.colors.emplace_back(static_cast<float>(i));
    mesh.joints.push_back({static_cast<uint16_t>(i), 0, 0, 0});
    mesh.weights.emplace_back(static_cast<float>(i));
    mesh.tangents.emplace_back(1.0f);
  }
  mesh.targets.push_back({mesh.positions, mesh.positions, mesh.positions});
  const ModelMesh before = mesh;
  ModelMesh flat = mesh;
  add_smooth_normals(mesh, 30.0f);
  add_flat_normals(flat);
  EXPECT_EQ(flat.positions.size(), 36u);
  for (const ModelMesh* after : {&mesh, &flat}) {
    EXPECT_TRUE(after->tangents.empty() && after->targets[0].tangents.empty());
    ASSERT_EQ(after->indices.size(), before.indices.size());
    for (std::size_t i = 0; i < before.indices.size(); ++i) {
      const uint32_t a = after->indices[i], b = before.indices[i];
      EXPECT_EQ(after->positions[a], before.positions[b]);
      EXPECT_EQ(after->uvs[1][a], before.uvs[1][b]);
      EXPECT_EQ(after->colors[a], before.colors[b]);
      EXPECT_EQ(after->joints[a], before.joints[b]);
      EXPECT_EQ(after->weights[a], before.weights[b]);
      EXPECT_EQ(after->targets[0].positions[a], before.targets[0].positions[b]);
      EXPECT_EQ(after->targets[0].normals[a], before.targets[0].normals[b]);
    }
  }
}

TEST(Normals, OfManyTrianglesAtOneEdgeTakeLinearTime) {
  // 200,000 triangles share an edge, so comparing all pairs would take minutes.
  constexpr uint32_t kCount = 200000;
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.indices.insert(mesh.indices.end(), {0, 1, i + 2});
  }
  add_smooth_normals(mesh, 0.0f);
  EXPECT_GT(mesh.positions.size(), kCount);
}

}  // namespace
}  // namespace halfspace
