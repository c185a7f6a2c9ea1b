// SPDX-License-Identifier: Apache-2.0
//
// Models without lighting: `"shading": "none"` and unlit materials. The model is made in memory, with an image for each kind of map.
#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>

#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {
namespace {

// A triangle that covers the image. The texel of its emission map is yellow; all others are white.
std::shared_ptr<const ModelAsset> triangle(const glm::vec3& emissive, bool unlit) {
  Model model;
  ModelMaterial& m = model.materials.emplace_back();
  m.base_color = {0.5f, 0.5f, 0.25f, 1};
  m.emissive = emissive;
  m.unlit = unlit;
  const auto add_map = [&](TextureUse& use, const glm::u8vec4& texel) {
    Image<glm::u8vec4> image(1, 1);
    image.at(0, 0) = texel;
    use.texture = static_cast<int>(model.textures.size());
    model.textures.push_back({static_cast<int>(model.images.size()), {}});
    model.images.push_back({.name = "map", .file = {}, .bytes = nullptr, .pixels = std::make_shared<const ColorPicture>(image)});
  };
  for (TextureUse* use : {&m.base_color_map, &m.metallic_map, &m.roughness_map, &m.normal_map, &m.occlusion_map})
    add_map(*use, glm::u8vec4(255));
  add_map(m.emissive_map, {255, 255, 0, 255});
  ModelMesh& mesh = model.meshes.emplace_back();
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.tangents.assign(3, {1, 0, 0, 1});
  mesh.uvs[0].assign(3, {0.5f, 0.5f});
  mesh.indices = {0, 1, 2};
  mesh.material = 0;
  model.nodes.emplace_back().meshes = {0};
  model.scenes.emplace_back().roots = {0};
  return std::make_shared<const ModelAsset>(std::move(model));
}

struct Drawn {
  glm::vec4 light;
  int maps = 0;  // that the shader samples
  bool filters_environment = false;
};
Drawn draw_model(const glm::vec3& emissive, bool unlit, const std::string& keys) {
  const Workers workers(1);
  const SceneFile file =
      SceneFile::parse(R"({"version": 1, "environments": {"e": {"type": "day_sky", "size": 16}}, "reflections": {"environment": "e"},
      "objects": {"a": {"shape": "file", "file": "/made/in/memory.obj")" +
                           keys + "}}}",
                       "test.json", {});
  SceneAssets assets(workers);
  assets.add_model("/made/in/memory.obj", triangle(emissive, unlit));
  const PreparedScene scene = assets.prepare(file.at(0), 9, 9);
  Image<glm::vec4> picture(9, 9);
  render(scene, picture, workers);
  Drawn out{picture.at(4, 4)};
  std::visit(
      [&]<class S>(const S& shader) {
        if constexpr (std::derived_from<S, MetallicMaterial>) {
          out.maps = static_cast<int>(std::ranges::count_if(shader.maps, [](const MaterialMap& m) { return m.map != nullptr; }));
          out.filters_environment = shader.environment != nullptr;
        }
      },
      scene.draws[0].shader);
  return out;
}

// All numbers are sums and products of powers of two, so the results are exact.
TEST(ModelShading, WithoutLightingEmissionIsAddedToTheBaseColor) {
  const Drawn d = draw_model({0.25f, 0.125f, 1}, false, R"(, "shading": "none")");
  EXPECT_EQ(d.light, glm::vec4(0.75f, 0.625f, 0.25f, 1)) << "the map removes blue";
  EXPECT_EQ(d.maps, 2) << "base color and emission";
  EXPECT_FALSE(d.filters_environment);
}

TEST(ModelShading, WithoutLightingAndEmissionOnlyTheColorMapIsSampled) {
  const Drawn d = draw_model(glm::vec3(0), false, R"(, "shading": "none")");
  EXPECT_EQ(d.light, glm::vec4(0.5f, 0.5f, 0.25f, 1));
  EXPECT_EQ(d.maps, 1);
}

// KHR_materials_unlit: the base color is the result.
TEST(ModelShading, UnlitMaterialsHaveNoEmission) {
  for (const char* keys : {"", R"(, "shading": "none")"}) {
    const Drawn d = draw_model({0.25f, 0.125f, 1}, true, keys);
    EXPECT_EQ(d.light, glm::vec4(0.5f, 0.5f, 0.25f, 1));
    EXPECT_EQ(d.maps, 1);
  }
}

TEST(ModelShading, LitMaterialsSampleAllMaps) {
  const Drawn d = draw_model({0.25f, 0.125f, 1}, false, "");
  EXPECT_EQ(d.maps, 6);
  EXPECT_TRUE(d.filters_environment);
}

}  // namespace
}  // namespace halfspace
