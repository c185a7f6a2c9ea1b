// SPDX-License-Identifier: Apache-2.0
//
// Tests bump maps of models that are built in memory instead of being read from a file.
#include <gtest/gtest.h>

#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {
namespace {

// Two triangles whose materials have the same bump map, given as pixels: a ramp, with repeat wrapping for the first and clamping for the
// second.
Model bumpy_triangles() {
  Model model;
  auto ramp = std::make_shared<Image<glm::u8vec4>>(8, 8);
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) ramp->at(x, y) = glm::u8vec4(32 * x, 0, 0, 255);
  }
  model.images = {{"ramp", {}, nullptr, std::make_shared<const ColorPicture>(*ramp)}};
  model.textures = {{0, {}}, {0, {}}};
  model.textures[1].sampler.wrap_s = model.textures[1].sampler.wrap_t = Wrap::clamp;
  model.nodes.resize(1);
  model.scenes = {{"", {0}}};
  for (int i = 0; i < 2; ++i) {
    ModelMaterial& material = model.materials.emplace_back();
    material.bump_map.texture = i;
    ModelMesh& mesh = model.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
    mesh.indices = {0, 1, 2};
    mesh.material = i;
    model.nodes[0].meshes.push_back(i);
  }
  return model;
}

// Returns the normal map of each draw of a model.
std::vector<const Texture2D*> normal_maps(const PreparedScene& scene) {
  std::vector<const Texture2D*> maps;
  for (const PreparedDraw& draw : scene.draws) {
    std::visit(
        [&]<class S>(const S& shader) {
          if constexpr (std::is_base_of_v<MetallicMaterial, S>) maps.push_back(shader.maps[kNormalMap].map);
        },
        draw.shader);
  }
  return maps;
}

TEST(ModelBumps, FromPixelsDependOnTheWrapMode) {
  const Workers workers(1);
  const SceneFile file = SceneFile::parse(
      R"({"version": 1, "ambient": 1, "objects": {"a": {"shape": "file", "file": "/made/in/memory.obj"}}})", "test.json", {});
  SceneAssets assets(workers);
  assets.add_model("/made/in/memory.obj", std::make_shared<const ModelAsset>(bumpy_triangles()));
  const PreparedScene scene = assets.prepare(file.at(0), 9, 9);
  const std::vector<const Texture2D*> maps = normal_maps(scene);
  ASSERT_EQ(maps.size(), 2u);
  ASSERT_NE(maps[0], nullptr);
  ASSERT_NE(maps[1], nullptr);
  // The repeated ramp falls at its edge, so its red component is on the other side of 1/2 there.
  EXPECT_GT(maps[0]->value(0, 7, 3).x, 0.5f);
  EXPECT_LT(maps[1]->value(0, 7, 3).x, 0.5f);
}

}  // namespace
}  // namespace halfspace
