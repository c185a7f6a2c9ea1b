// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/ray_scene.h"

#include <gtest/gtest.h>

#include "halfspace/geometry/shapes.h"

namespace halfspace {
namespace {

struct World {
  Mesh ground = plane(4.0f), ball = uv_sphere(64, 128, 1.0f);
  std::vector<PlacedMesh> meshes;
  World() {
    glm::dmat4 below(1.0), above(1.0);
    below[3].y = -1.5;
    above[3].y = 0.5;
    meshes.push_back({ground.positions, ground.normals, std::make_shared<const Indices>(ground.indices, ground.positions.size()), below,
                      true, true, true});
    meshes.push_back(
        {ball.positions, ball.normals, std::make_shared<const Indices>(ball.indices, ball.positions.size()), above, false, true, true});
  }
};

TEST(RayScene, ReturnsTheNearestHit) {
  const World world;
  const glm::dvec3 eye(0, 10, 0);
  const RayScene rays(world.meshes, eye);
  const auto down = rays.nearest({0.01f, 0, 0.02f}, {0, -1, 0}, 0.0f, 100.0f);
  ASSERT_TRUE(down);
  EXPECT_EQ(down->mesh, 1);
  // The facets of the sphere are at most 1 - cos(pi/128) = 3e-4 below its surface.
  EXPECT_NEAR(down->position_rws.y, 1.5 - 10.0, 1e-3);
  EXPECT_NEAR(down->face_normal_ws.y, 1.0, 2e-3);
  const auto beside = rays.nearest({1.5f, 0, 1.5f}, {0, -1, 0}, 0.0f, 100.0f);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->mesh, 0);
  EXPECT_EQ(beside->position_rws.y, -11.5);
  EXPECT_NEAR(beside->weights[0] + beside->weights[1] + beside->weights[2], 1.0, 1e-15);
  EXPECT_FALSE(rays.nearest({3.0f, 0, 0}, {0, -1, 0}, 0.0f, 100.0f));
  EXPECT_FALSE(rays.nearest({0, 0, 0}, {0, -1, 0}, 0.0f, 5.0f));  // ends in front of the sphere
}

TEST(RayScene, HitPositionsMatchTheirWeights) {
  const World world;
  const glm::dvec3 eye(3, 4, 5);
  const RayScene rays(world.meshes, eye);
  const auto hit = rays.nearest({0, 0, 0}, glm::vec3(-3.0f, -3.5f, -5.0f), 0.0f, 100.0f);
  ASSERT_TRUE(hit);
  const PlacedMesh& placed = world.meshes[static_cast<std::size_t>(hit->mesh)];
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3& p = placed.positions[(*placed.indices)[3 * hit->triangle + k]];
    sum += hit->weights[k] * (glm::dvec3(placed.world_from_object * glm::dvec4(glm::dvec3(p), 1.0)) - eye);
  }
  EXPECT_LT(glm::length(sum - hit->position_rws), 1e-14);
  // Embree's float distances are accurate to a few ulps.
  EXPECT_LT(glm::length(hit->position_rws - static_cast<double>(hit->distance) * glm::dvec3(-3, -3.5, -5)), 1e-5);
}

TEST(RayScene, OnlyCastersOccludeInACasterScene) {
  World world;
  world.meshes[1].casts_shadow = false;
  const RayScene all(world.meshes, glm::dvec3(0.0)), casters(world.meshes, glm::dvec3(0.0), true);
  EXPECT_TRUE(all.occluded({0, 5, 0}, {0, -1, 0}, 0.0f, 5.0f));
  EXPECT_FALSE(casters.occluded({0, 5, 0}, {0, -1, 0}, 0.0f, 5.0f));
  EXPECT_TRUE(casters.occluded({0, 5, 0}, {0, -1, 0}, 0.0f, 10.0f));
  EXPECT_EQ(casters.nearest({0, 5, 0}, {0, -1, 0}, 0.0f, 10.0f)->mesh, 0);
}

}  // namespace
}  // namespace halfspace
