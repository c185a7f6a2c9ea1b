// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace halfspace {
namespace {

// Two triangles that share the edge from (0, 0, 0) to (0, 1, 0). On the right, u increases along x; on the left, in the direction given by
// `sign`.
ModelMesh two_triangles(float sign) {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs[0] = {{0, 1}, {1, 1}, {0, 0}, {-sign, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST(Tangents, FollowIncreasingU) {
  ModelMesh mesh = two_triangles(1.0f);
  add_tangents(mesh, 0);
  // The bitangent, cross(normal, tangent) · w, points up, where v decreases.
  EXPECT_EQ(mesh.tangents, std::vector<glm::vec4>(4, {1, 0, 0, 1}));
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Tangents, SplitVerticesWhereTextureCoordinatesAreMirrored) {
  ModelMesh mesh = two_triangles(-1.0f);
  mesh.colors.assign(4, glm::vec4(0.5f));
  add_tangents(mesh, 0);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.colors.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const bool left = i >= 3;
    EXPECT_EQ(mesh.tangents[mesh.indices[i]], left ? glm::vec4(-1, 0, 0, -1) : glm::vec4(1, 0, 0, 1));
  }
  EXPECT_EQ(mesh.positions[mesh.indices[3]], glm::vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions[mesh.indices[4]], glm::vec3(0, 1, 0));
}

// The angles at vertex 0 are 90° in the right triangle and 45° in the left one, where u = x and v = x − y.
TEST(Tangents, AreWeightedByAngles) {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, -1}, {-1, -2}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  add_tangents(mesh, 0);
  // In the left triangle, u increases and v is constant in the direction (1, 1).
  const double left_weight = std::numbers::pi / 4.0, right_weight = std::numbers::pi / 2.0, s = std::sqrt(0.5);
  const glm::dvec2 sum(right_weight + left_weight * s, left_weight * s);
  const glm::dvec2 mean = sum / std::sqrt(glm::dot(sum, sum));
  EXPECT_NEAR(mesh.tangents[0].x, mean.x, 1e-6);
  EXPECT_NEAR(mesh.tangents[0].y, mean.y, 1e-6);
  EXPECT_EQ(mesh.tangents[1], glm::vec4(1, 0, 0, 1));
}

// The expected tangents were computed with M. Mikkelsen's algorithm, in single precision (npm package mikktspace 1.1.1). The sign of w is
// inverted, because v points down in our textures.
TEST(Tangents, EqualThoseOfMikkTSpace) {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 2}, {3, 0, 0}, {1, 3, 1}, {-2, 2, 0}, {-3, 0, 1}, {-1, -3, 0}, {2, -2, 1}};
  for (const glm::vec3& n : {glm::vec3(0, 1, 4), glm::vec3(3, 0, 1), glm::vec3(1, 2, 1), glm::vec3(-1, 2, 2), glm::vec3(-3, 0, 1),
                             glm::vec3(-1, -2, 2), glm::vec3(2, -2, 1)}) {
    mesh.normals.push_back(n / std::sqrt(glm::dot(n, n)));
  }
  mesh.uvs[0] = {{0.5f, 0.5f}, {0.9f, 0.4f}, {0.7f, 0.9f}, {0.2f, 0.8f}, {0.1f, 0.5f}, {0.4f, 0.1f}, {0.8f, 0.2f}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 1};
  add_tangents(mesh, 0);
  const glm::vec3 expected[] = {{0.9948342f, 0.0984818f, -0.0246204f},  {0.3059611f, 0.2527412f, -0.9178833f},
                                {0.9119779f, -0.3450155f, -0.2219471f}, {0.9177800f, 0.0675965f, 0.3912935f},
                                {0.3162278f, 0.0f, 0.9486833f},         {0.9217107f, -0.0816736f, 0.3791818f},
                                {0.7419935f, 0.5511642f, -0.3816589f}};
  ASSERT_EQ(mesh.tangents.size(), std::size(expected));
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(mesh.tangents[i][c], expected[i][c], 1e-6f) << i;  // float rounding
    EXPECT_EQ(mesh.tangents[i].w, -1.0f);
  }
}

TEST(Tangents, AverageVerticesThatAreEqual) {
  ModelMesh mesh = two_triangles(1.0f);
  mesh.uvs[0][3] = {-1, 2};  // a different direction of u on the left
  ModelMesh separate = mesh;
  for (auto* list : {&separate.positions, &separate.normals}) list->clear();
  separate.uvs[0].clear();
  for (std::size_t i = 0; i < 6; ++i) {
    const uint32_t v = mesh.indices[i];
    separate.positions.push_back(mesh.positions[v]);
    separate.normals.push_back(mesh.normals[v]);
    separate.uvs[0].push_back(mesh.uvs[0][v]);
    separate.indices[i] = static_cast<uint32_t>(i);
  }
  add_tangents(mesh, 0);
  add_tangents(separate, 0);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(separate.tangents[i], mesh.tangents[mesh.indices[i]]);
  EXPECT_NE(mesh.tangents[0].y, 0.0f);  // the mean of both triangles
  EXPECT_EQ(mesh.tangents[1].y, 0.0f);
}

TEST(Tangents, ArePerpendicularToTheNormalWhereTextureCoordinatesAreDegenerate) {
  ModelMesh mesh = two_triangles(1.0f);
  mesh.uvs[0].assign(4, {0.5f, 0.5f});
  mesh.normals.assign(4, {0.6f, 0.0f, 0.8f});
  add_tangents(mesh, 0);
  for (const glm::vec4& t : mesh.tangents) {
    EXPECT_NEAR(glm::dot(glm::vec3(t), glm::vec3(0.6f, 0.0f, 0.8f)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(glm::vec3(t), glm::vec3(t)), 1.0f, 1e-6f);
    EXPECT_EQ(t.w, 1.0f);
  }
}

TEST(Tangents, UseTheGivenSet) {
  ModelMesh mesh = two_triangles(1.0f);
  mesh.uvs[1] = {{0, 0}, {0, 1}, {1, 0}, {0, -1}};  // u increases along y
  add_tangents(mesh, 1);
  EXPECT_EQ(glm::vec3(mesh.tangents[0]), glm::vec3(0, 1, 0));
}

}  // namespace
}  // namespace halfspace
