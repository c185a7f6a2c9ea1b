// SPDX-License-Identifier: Apache-2.0
//
// Tests parents of objects, several particle systems, and scene materials on model files.
#include <gtest/gtest.h>

#include "halfspace/model/model.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"

namespace halfspace {
namespace {

PreparedScene prepared(const std::string& objects, const Workers& workers) {
  const SceneFile scene = SceneFile::parse(
      R"({"version": 1, "ambient": 1, "materials": {"red": {"color": [1, 0, 0], "shading": "none"}}, )" + objects + "}", "test.json", {});
  SceneAssets assets(workers);
  return assets.prepare(scene.at(0), 64, 64);
}

// The matrices are exact, because all numbers are integers and all rotations are multiples of 90 degrees.
TEST(SceneGraph, ObjectsArePlacedRelativeToTheirAncestors) {
  const Workers workers(1);
  const PreparedScene scene = prepared(R"("objects": {
      "hand": {"parent": "arm", "position": [2, 0, 0]},
      "arm": {"parent": "body", "position": [0, 3, 0], "rotation": [0, 90, 0], "scale": [2, 2, 2]},
      "body": {"position": [10, 0, 0], "visible": false}})",
                                       workers);
  ASSERT_EQ(scene.meshes.size(), 2u) << "the invisible parent is not drawn";
  EXPECT_EQ(scene.meshes[0].world_from_object * glm::dvec4(0, 0, 0, 1), glm::dvec4(10, 3, -4, 1));
  EXPECT_EQ(scene.meshes[0].world_from_object * glm::dvec4(1, 0, 0, 1), glm::dvec4(10, 3, -6, 1));
  EXPECT_EQ(scene.meshes[1].world_from_object * glm::dvec4(0, 0, 0, 1), glm::dvec4(10, 3, 0, 1));
}

TEST(SceneGraph, InstancesAreRelativeToTheObjectAndItsParent) {
  const Workers workers(1);
  const PreparedScene scene = prepared(R"("objects": {
      "a": {"parent": "b", "position": [1, 0, 0], "instances": [{"position": [0, 1, 0]}, {"position": [0, 2, 0]}]},
      "b": {"position": [0, 0, 5], "visible": false}})",
                                       workers);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(glm::dvec3(scene.meshes[0].world_from_object[3]), glm::dvec3(1, 1, 5));
  EXPECT_EQ(glm::dvec3(scene.meshes[1].world_from_object[3]), glm::dvec3(1, 2, 5));
  EXPECT_EQ(scene.meshes[0].positions.data(), scene.meshes[1].positions.data()) << "copies share their mesh";
}

TEST(SceneGraph, EachParticleSystemIsOneDraw) {
  const Workers workers(1);
  const PreparedScene scene = prepared(R"("particles": {"sprite": "exact", "count": 3}, "particle_systems": {
      "a": {"sprite": "exact", "count": 5}, "b": {"count": 7}, "none": {}})",
                                       workers);
  ASSERT_EQ(scene.draws.size(), 3u);
  EXPECT_EQ(scene.draws[0].indices->size(), 3);
  EXPECT_EQ(scene.draws[1].indices->size(), 5);
  EXPECT_EQ(scene.draws[2].indices->size(), 7);
  ASSERT_EQ(scene.spheres.size(), 2u) << "original sprites are not spheres";
}

// A triangle that covers the image, with a green unlit material named Paint.
std::shared_ptr<const ModelAsset> green_triangle() {
  Model model;
  ModelMaterial& paint = model.materials.emplace_back();
  paint.name = "Paint";
  paint.base_color = {0, 1, 0, 1};
  paint.unlit = true;
  ModelMesh& mesh = model.meshes.emplace_back();
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.indices = {0, 1, 2};
  mesh.material = 0;
  ModelNode& node = model.nodes.emplace_back();
  node.meshes = {0};
  ModelScene& scene = model.scenes.emplace_back();
  scene.roots = {0};
  return std::make_shared<const ModelAsset>(std::move(model));
}

glm::u8vec4 center_color(const std::string& keys) {
  const Workers workers(1);
  SceneFile file = SceneFile::parse(R"({"version": 1, "ambient": 1,
      "materials": {"red": {"color": [1, 0, 0], "shading": "none"}, "blue": {"color": [0, 0, 1], "shading": "none"}},
      "objects": {"a": {"shape": "file", "file": "/made/in/memory.obj")" +
                                        keys + "}}}",
                                    "test.json", {});
  SceneAssets assets(workers);
  assets.add_model("/made/in/memory.obj", green_triangle());
  Image<glm::u8vec4> picture(9, 9);
  render(assets.prepare(file.at(0), 9, 9), picture, workers);
  return picture.at(4, 4);
}

TEST(SceneGraph, MaterialsOfTheSceneReplaceThoseOfAModel) {
  EXPECT_EQ(center_color(""), glm::u8vec4(0, 255, 0, 255)) << "the model's own material";
  EXPECT_EQ(center_color(R"(, "material": "red")"), glm::u8vec4(255, 0, 0, 255));
  EXPECT_EQ(center_color(R"(, "model_materials": "Glass=red, Paint=blue")"), glm::u8vec4(0, 0, 255, 255));
  EXPECT_EQ(center_color(R"(, "model_materials": "Glass=red")"), glm::u8vec4(0, 255, 0, 255)) << "no entry for its material";
  EXPECT_EQ(center_color(R"(, "material": "red", "model_materials": "Paint=blue")"), glm::u8vec4(0, 0, 255, 255)) << "the entry wins";
}

}  // namespace
}  // namespace halfspace
