// SPDX-License-Identifier: Apache-2.0
//
// Checks which parts of models are simplified (model_error), and that shadows use the same triangles. tests/reference/model_error_test.cpp
// compares the outlines.
#include <gtest/gtest.h>

#include <functional>

#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "model/test_meshes.h"
#include "support/workers.h"

namespace halfspace {
namespace {

using EditModel = std::function<void(Model&)>;

// A model with one sphere of 4,896 triangles.
std::shared_ptr<const ModelAsset> sphere_model(const EditModel& edit) {
  Model model;
  model.meshes.push_back(sphere(72, 35));
  model.meshes[0].normals = model.meshes[0].positions;
  model.meshes[0].material = 0;
  model.materials.emplace_back().name = "Paint";
  model.nodes.emplace_back().meshes = {0};
  model.scenes.emplace_back().roots = {0};
  edit(model);
  return std::make_shared<const ModelAsset>(std::move(model));
}

// The sphere is about 20 px high.
constexpr const char* kFarCamera = R"("position": [0, 0, 20], "fov": 45)";

PreparedScene prepared_sphere(const std::string& keys, const EditModel& edit, const std::string& camera = kFarCamera) {
  const std::string text = R"({"version": 1, "ambient": 1, "cameras": {"c": {)" + camera + R"(}},
      "materials": {"flat": {"shading": "flat"}, "smooth": {}},
      "objects": {"a": {"shape": "file", "file": "/made/in/memory.obj")" +
                           keys + "}}}";
  SceneAssets assets(one_worker());
  assets.add_model("/made/in/memory.obj", sphere_model(edit));
  return assets.prepare(SceneFile::parse(text, "test.json", {}).at(0), 160, 160);
}

// Returns the number of triangles that are drawn.
std::size_t drawn(
    const std::string& keys, const EditModel& edit = [](Model&) {}, const std::string& camera = kFarCamera) {
  const PreparedScene scene = prepared_sphere(keys, edit, camera);
  EXPECT_EQ(scene.draws[0].indices, scene.meshes[0].indices) << "shadows";
  return scene.draws[0].indices->size() / 3;
}

constexpr std::size_t kAll = 4896;
constexpr const char* kHalfPixelError = R"(, "model_error": 0.5)";

TEST(ModelDetail, IsChosenForTheView) {
  EXPECT_EQ(drawn(""), kAll);
  const std::size_t half = drawn(kHalfPixelError);
  EXPECT_LT(half, kAll / 4);
  EXPECT_LT(drawn(R"(, "model_error": 4)"), half);
  EXPECT_LT(drawn(
                kHalfPixelError, [](Model&) {}, R"("position": [0, 0, 80], "fov": 45)"),
            half);
  EXPECT_EQ(drawn(
                kHalfPixelError, [](Model&) {}, R"("position": [0, 0, 2], "fov": 45)"),
            kAll)
      << "more pixels than triangles";
  EXPECT_EQ(drawn(R"(, "model_error": 0.5, "scale": [9, 1, 1])"), kAll) << "the longest axis decides";
  EXPECT_LT(drawn(
                kHalfPixelError, [](Model&) {}, R"("position": [0, 0, 20], "type": "orthographic", "height": 16)"),
            kAll / 4);
}

TEST(ModelDetail, IsReported) {
  const PreparedScene scene = prepared_sphere(R"(, "model_error": 0.5, "instances": [{}, {"position": [2, 0, 0]}])", [](Model&) {});
  ASSERT_EQ(scene.simplified.size(), 1u);
  const SimplifiedObject& s = scene.simplified[0];
  EXPECT_EQ(s.triangles, 2 * kAll);
  EXPECT_EQ(s.drawn, (scene.draws[0].indices->size() + scene.draws[1].indices->size()) / 3);
  EXPECT_EQ(scene.draws[0].indices, scene.draws[1].indices) << "copies share a list";
  EXPECT_GT(s.error_px, 0.05);
  EXPECT_LE(s.error_px, 0.5);
}

TEST(ModelDetail, OutlinesThatItDoesNotKnowStayExact) {
  EXPECT_EQ(drawn(kHalfPixelError, [](Model& m) { m.materials[0].alpha_mode = AlphaMode::mask; }), kAll);
  EXPECT_EQ(drawn(kHalfPixelError, [](Model& m) { m.materials[0].alpha_mode = AlphaMode::blend; }), kAll);
  EXPECT_EQ(drawn(kHalfPixelError,
                  [](Model& m) {
                    m.meshes[0].targets.push_back({m.meshes[0].positions, {}, {}});
                    m.nodes[0].morph_weights = {0.5f};
                  }),
            kAll);
  EXPECT_EQ(drawn(R"(, "model_error": 0.5, "material": "flat")"), kAll);
  EXPECT_EQ(drawn(R"(, "model_error": 0.5, "normal_lines": 0.1)"), kAll);
  EXPECT_LT(drawn(R"(, "model_error": 0.5, "material": "smooth")"), kAll / 4);
  EXPECT_EQ(drawn(kHalfPixelError, [](Model& m) { m.meshes[0].indices.resize(3 * 1000); }), 1000u) << "a small mesh";
}

// The bound must hold for colors as well, and there is none.
TEST(ModelDetail, IsNotChosenWithAColorError) {
  const SceneDescription scene =
      SceneFile::parse(R"({"version": 1, "objects": {"a": {"shape": "file", "file": "/a.obj"}}})", "test.json", {}).description();
  SceneAssets assets(one_worker());
  const auto chosen = [&](const AllowedError& allowed) {
    return assets.choose_within_error(scene, 160, 160, allowed).scene.objects[0].second.model_error;
  };
  EXPECT_EQ(chosen({0.5, std::nullopt}), 0.5);
  EXPECT_EQ(chosen({0.5, 8.0}), 0.0);
  EXPECT_EQ(chosen({std::nullopt, 8.0}), 0.0);
}

}  // namespace
}  // namespace halfspace
