// SPDX-License-Identifier: Apache-2.0
//
// Compares the outlines of simplified models with those of the exact ones.
#include <gtest/gtest.h>

#include <array>

#include "halfspace/reference/silhouettes.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "model/test_meshes.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr int kModelWidth = 96, kModelHeight = 54, kModelFiner = 8;

// Two copies of one mesh, of which one is stretched and turned.
std::shared_ptr<const ModelAsset> stones() {
  Model model;
  model.meshes.push_back(stone(80, 40));
  for (const double x : {-1.5, 1.5}) {
    ModelNode& node = model.nodes.emplace_back();
    node.transform.translation = {x, 0.0, 0.0};
    if (x > 0.0) {
      node.transform.scale = {0.7, 1.6, 1.0};
      node.transform.rotation = glm::dquat(0.8, 0.36, 0.0, 0.48);
    }
    node.meshes = {0};
  }
  model.scenes.emplace_back().roots = {0, 1};
  return std::make_shared<const ModelAsset>(std::move(model));
}

SceneDescription scene_of_stones(const std::string& camera) {
  return SceneFile::parse(R"({"version": 1, "cameras": {"c": {)" + camera + R"(}}, "lights": {"l": {"direction": [1, 1, 1]}},
                              "objects": {"stones": {"shape": "file", "file": "/made/in/memory.obj"}}})",
                          "test.json", {})
      .description();
}

struct ModelOutline {
  double distance;  // from the exact outline, in pixels
  SimplifiedObject simplified;
};

ModelOutline outline_of(const std::string& camera, double allowed_px, SceneAssets& assets) {
  const SceneDescription scene = scene_of_stones(camera);
  const auto seen = [&](const SceneDescription& s) {
    return seen_objects(assets.prepare(s, kModelWidth, kModelHeight), kModelFiner, two_workers());
  };
  const SceneDescription chosen = assets.choose_within_error(scene, kModelWidth, kModelHeight, {allowed_px, std::nullopt}).scene;
  const PreparedScene prepared = assets.prepare(chosen, kModelWidth, kModelHeight);
  const double distance = silhouette_distance(seen(chosen), seen(scene), kModelFiner).max;
  return {distance, prepared.simplified.front()};
}

TEST(ModelError, OutlinesAreWithinTheLimit) {
  constexpr std::array kCameras{R"("position": [1, 2, 14], "fov": 40)", R"("position": [7, 1, 6], "fov": 60)",
                                R"("position": [2, 2, 9], "type": "orthographic", "height": 12)"};
  SceneAssets assets(two_workers());
  assets.add_model("/made/in/memory.obj", stones());
  for (const std::string camera : kCameras) {
    for (const double allowed : {0.5, 2.0}) {
      const ModelOutline outline = outline_of(camera, allowed, assets);
      EXPECT_LE(outline.simplified.error_px, allowed) << camera;
      EXPECT_LE(outline.distance, outline.simplified.error_px + 1.0 / kModelFiner) << camera;
      EXPECT_LT(outline.simplified.drawn, outline.simplified.triangles) << camera;
    }
  }
}

// Without the option, the draws have all triangles of the file.
TEST(ModelError, ModelsAreExactByDefault) {
  SceneAssets assets(one_worker());
  assets.add_model("/made/in/memory.obj", stones());
  const PreparedScene prepared = assets.prepare(scene_of_stones(R"("position": [1, 2, 14])"), kModelWidth, kModelHeight);
  EXPECT_TRUE(prepared.simplified.empty());
  ASSERT_EQ(prepared.meshes.size(), 2u);
  EXPECT_EQ(prepared.meshes[0].indices->size(), stone(80, 40).indices.size());
}

}  // namespace
}  // namespace halfspace
