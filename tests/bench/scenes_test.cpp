// SPDX-License-Identifier: Apache-2.0
//
// Draws every row of the composed scenes once, and checks what the scenes contain. peers_test.cpp compares the pictures with OpenGL.
#include "scenes/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "workloads/workload_assets.h"

namespace halfspace {

void PrintTo(const SceneRow& row, std::ostream* out) { *out << row.name; }

namespace {

constexpr WorkloadSize kSceneSize{320, 180};
constexpr std::array kKinds{SceneKind::hall, SceneKind::garden, SceneKind::workshop};

// The scenes are generated only once.
WorkloadAssets& shared_assets() {
  static WorkloadAssets assets;
  return assets;
}

class ScenePictures : public testing::TestWithParam<const SceneRow*> {};

TEST_P(ScenePictures, AreCoveredAndDoNotDependOnTheThreads) {
  const auto index = static_cast<std::size_t>(GetParam() - scene_rows().data());
  const std::unique_ptr<Workload> workload = scene_workloads()[index].prepare(kSceneSize, shared_assets());
  workload->frame(Workers(1));
  const Image<glm::u8vec4> first = *workload->picture().color;
  workload->frame(Workers(3));
  EXPECT_TRUE(*workload->picture().color == first) << "depends on the number of threads";
  // The sky and the ground enclose the scene.
  EXPECT_EQ(std::ranges::count(workload->picture().depth->texels(), 1.0f), 0);
}

std::vector<const SceneRow*> all_scene_rows() {
  std::vector<const SceneRow*> rows;
  for (const SceneRow& row : scene_rows()) rows.push_back(&row);
  return rows;
}

std::string name_of_scene_row(const testing::TestParamInfo<const SceneRow*>& info) { return info.param->name; }

INSTANTIATE_TEST_SUITE_P(All, ScenePictures, testing::ValuesIn(all_scene_rows()), name_of_scene_row);

TEST(Scenes, HaveFifteenRows) {
  EXPECT_EQ(scene_rows().size(), 15u);
  for (const SceneRow& row : scene_rows()) EXPECT_EQ(std::ranges::count(scene_rows(), row.name, &SceneRow::name), 1) << row.name;
}

TEST(Scenes, HaveTheStatedContents) {
  for (const SceneKind kind : kKinds) {
    const Scene& scene = *shared_scene(shared_assets(), kind);
    EXPECT_GE(scene.triangles(), 50'000u);
    EXPECT_LE(scene.triangles(), 500'000u);
    EXPECT_GE(scene.textures.size(), 10u);
    for (const auto& texture : scene.textures) {
      EXPECT_FALSE(std::has_single_bit(static_cast<unsigned>(texture->width())) &&
                   std::has_single_bit(static_cast<unsigned>(texture->height())));
    }
    for (const SceneSurface surface : {SceneSurface::opaque, SceneSurface::cutout, SceneSurface::unlit, SceneSurface::blended}) {
      EXPECT_TRUE(std::ranges::any_of(scene.objects, [&](const SceneObject& o) { return scene.material(o).surface == surface; }));
    }
  }
}

TEST(Scenes, BlendedObjectsAreDrawnLastAndBackToFront) {
  for (const SceneRow& row : scene_rows()) {
    const Scene& scene = *shared_scene(shared_assets(), row.kind);
    const SceneCamera& camera = scene.cameras[row.camera];
    const SceneView view = scene_view(scene, camera, kSceneSize);
    ASSERT_EQ(view.order.size(), scene.objects.size());
    double last = 1e9;
    bool has_blended = false;
    for (const std::size_t i : view.order) {
      const SceneObject& object = scene.objects[i];
      if (scene.material(object).surface != SceneSurface::blended) {
        EXPECT_FALSE(has_blended) << row.name;
        continue;
      }
      has_blended = true;
      const double distance = glm::length(glm::dvec3(object.world_from_object * glm::dvec4(scene.mesh(object).center(), 1.0)) - camera.eye);
      EXPECT_LE(distance, last + 1e-9) << row.name;
      last = distance;
    }
    EXPECT_TRUE(has_blended) << row.name;
  }
}

// Returns the number of triangles of a mesh whose vertex normals point to their back.
int inverted_triangles(const Scene& scene, const SceneMesh& mesh) {
  int inverted = 0;
  for (uint32_t t = mesh.first; t < mesh.first + mesh.count; t += 3) {
    const std::array<SceneVertex, 3> v{scene.vertices[scene.indices[t]], scene.vertices[scene.indices[t + 1]],
                                       scene.vertices[scene.indices[t + 2]]};
    const glm::vec3 face = glm::cross(v[1].position - v[0].position, v[2].position - v[0].position);
    inverted += glm::dot(face, v[0].normal + v[1].normal + v[2].normal) >= 0.0f ? 0 : 1;  // also counts NaN
  }
  return inverted;
}

TEST(Scenes, NormalsPointToTheFront) {
  for (const SceneKind kind : kKinds) {
    const Scene& scene = *shared_scene(shared_assets(), kind);
    for (const SceneObject& object : scene.objects) {
      if (!scene.material(object).two_sided) {
        EXPECT_EQ(inverted_triangles(scene, scene.mesh(object)), 0) << "mesh " << object.mesh;
      }
    }
  }
}

}  // namespace

}  // namespace halfspace
