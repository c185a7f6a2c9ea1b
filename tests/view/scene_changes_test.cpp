// SPDX-License-Identifier: Apache-2.0
#include "view/scene_changes.h"

#include <gtest/gtest.h>

#include "halfspace/scene/scene_paths.h"

namespace halfspace {
namespace {

const char* const kChangedScenes[] = {"moon", "particles", "day-night", "three-lights", "earth"};

std::string value_in(const SceneFile& scene, const std::string& path) {
  SceneDescription d = scene.description();
  return value_text(find_key(d, path, "test").field);
}

TEST(SceneChanges, ReliefOfTheEarthCyclesThroughMapBumpAndNone) {
  SceneFile scene = SceneFile::open("earth");
  EXPECT_EQ(value_in(scene, "earth.normal"), "map");
  for (const char* expected : {"bump", "none", "map"}) {
    cycle_relief(scene, nullptr);
    EXPECT_EQ(value_in(scene, "earth.normal"), expected);
  }
}

TEST(SceneChanges, ReliefOfADisplacedSurfaceCyclesThroughItsNormals) {
  SceneFile scene = SceneFile::open("moon");
  for (const char* expected : {"vertex", "undisplaced", "pixel"}) {
    cycle_relief(scene, nullptr);
    EXPECT_EQ(value_in(scene, "moon.normals"), expected);
  }
}

TEST(SceneChanges, ShadingIsSetForEveryObject) {
  SceneFile scene = SceneFile::open("day-night");
  EXPECT_EQ(set_shading_rate(scene, "flat"), "shading flat: 7 objects");
  for (const auto& [name, object] : scene.description().objects) EXPECT_EQ(object.surface.shading, ShadingRate::flat) << name;
}

TEST(SceneChanges, TexturesAreToggled) {
  SceneFile scene = SceneFile::open("earth");
  toggle_color_maps(scene, nullptr);
  EXPECT_EQ(value_in(scene, "earth.textured"), "false");
  toggle_color_maps(scene, nullptr);
  EXPECT_EQ(value_in(scene, "earth.textured"), "true");
}

// A scene like the one that is generated for a model file.
SceneFile scene_of_model() {
  return SceneFile::parse(R"({ "version": 1, "cameras": { "main": {} },
    "objects": { "model": { "shape": "file", "file": "/a.obj" }, "floor": { "shape": "plane", "shadow_only": true } } })",
                          "test", {});
}

TEST(SceneChanges, KeysActOnTheMaterialsOfAModel) {
  SceneFile scene = scene_of_model();
  Model model;
  model.materials.resize(2);
  EXPECT_EQ(toggle_color_maps(scene, &model), "no material of this model has a color map");
  EXPECT_EQ(cycle_relief(scene, &model), "no material of this model has a normal or bump map");
  model.materials[1].base_color_map.texture = 0;
  model.materials[1].bump_map.texture = 0;
  EXPECT_EQ(toggle_color_maps(scene, &model), "textures off: 1 object");
  EXPECT_EQ(value_in(scene, "model.textured"), "false");
  EXPECT_EQ(toggle_color_maps(scene, &model), "textures on: 1 object");
  EXPECT_EQ(cycle_relief(scene, &model), "objects.model.normal=none");
  EXPECT_EQ(cycle_relief(scene, &model), "objects.model.normal=auto");
}

TEST(SceneChanges, ModelsAreLitPerPixelOrNotAtAll) {
  SceneFile scene = scene_of_model();
  EXPECT_EQ(set_shading_rate(scene, "none"), "shading none: 1 object");
  EXPECT_EQ(value_in(scene, "model.shading"), "none");
  for (const char* rate : {"flat", "gouraud"})
    EXPECT_EQ(set_shading_rate(scene, rate), std::string("shading ") + rate + " is not available for model files; press 0 or 3");
  EXPECT_EQ(value_in(scene, "model.shading"), "none") << "the floor, which only shows shadows, is not an object to shade";
  EXPECT_EQ(set_shading_rate(scene, "phong"), "shading phong: 1 object");
}

TEST(SceneChanges, TogglingShadowsTwiceRestoresTheirMethod) {
  SceneFile scene = SceneFile::open("moon");
  scene.set("shadow.method=vogel");
  ShadowToggle toggle;
  toggle.toggle(scene);
  EXPECT_EQ(value_in(scene, "shadow.method"), "none");
  toggle.toggle(scene);
  EXPECT_EQ(value_in(scene, "shadow.method"), "vogel");
}

TEST(SceneChanges, VisibilityAppliesToThePickedObjectOrToAll) {
  SceneFile scene = SceneFile::open("three-lights");
  VisibilityToggle toggle;
  toggle.toggle(scene, "cube");
  EXPECT_EQ(value_in(scene, "cube.visible"), "false");
  EXPECT_EQ(value_in(scene, "globe.visible"), "true");
  toggle.forget_object();
  toggle.toggle(scene, "");
  EXPECT_EQ(value_in(scene, "globe.visible"), "false");
  toggle.toggle(scene, "");
  EXPECT_EQ(value_in(scene, "cube.visible"), "true");
  EXPECT_EQ(value_in(scene, "globe.visible"), "true");
}

TEST(SceneChanges, ParticlesAreHiddenAndShownAgain) {
  SceneFile scene = SceneFile::open("particles");
  VisibilityToggle toggle;
  toggle.toggle(scene, "");
  EXPECT_EQ(value_in(scene, "particles.count"), "0");
  toggle.toggle(scene, "");
  EXPECT_EQ(value_in(scene, "particles.count"), "12");
}

TEST(SceneChanges, ExposureIsMultiplied) {
  SceneFile scene = SceneFile::open("day-night");
  change_exposure(scene, 2.0);
  EXPECT_EQ(value_in(scene, "post.exposure"), "1.6");
  EXPECT_EQ(value_in(scene, "post.tone"), "exponential");
}

TEST(SceneChanges, ExposureLeavesOtherDisplaySettingsUnchanged) {
  SceneFile scene = SceneFile::open("earth");
  change_exposure(scene, 2.0);
  EXPECT_EQ(value_in(scene, "post.hdr"), "true");
  EXPECT_EQ(value_in(scene, "post.tone"), "none");
  EXPECT_EQ(value_in(scene, "post.exposure"), "2.0");
}

TEST(SceneChanges, EveryChangeKeepsEachSceneValidAndReturnsAMessage) {
  for (const char* name : kChangedScenes) {
    SceneFile scene = SceneFile::open(name);
    VisibilityToggle visibility;
    ShadowToggle shadows;
    for (int round = 0; round < 3; ++round) {
      for (const char* rate : {"none", "flat", "gouraud", "phong"}) EXPECT_FALSE(set_shading_rate(scene, rate).empty()) << name;
      EXPECT_FALSE(cycle_relief(scene, nullptr).empty()) << name;
      EXPECT_FALSE(toggle_color_maps(scene, nullptr).empty()) << name;
      EXPECT_FALSE(shadows.toggle(scene).empty()) << name;
      EXPECT_FALSE(visibility.toggle(scene, "").empty()) << name;
      EXPECT_FALSE(change_exposure(scene, 1.5).empty()) << name;
      EXPECT_NO_THROW(scene.at(2.5)) << name;
    }
  }
}

TEST(SceneChanges, CameraKeysKeepAllBits) {
  SceneFile scene = SceneFile::open("earth");
  CameraDescription camera = scene.description().cameras.front().second;
  camera.position = {1.0 / 3.0, -2e-7 / 7.0, 1e5 / 3.0};
  set_camera_keys(scene, "equator", camera);
  EXPECT_EQ(scene.description().cameras.front().second.position, camera.position);
}

TEST(SceneChanges, AnimatedCamerasAreRecognized) {
  SceneFile scene = SceneFile::open("earth");
  EXPECT_FALSE(is_animated_camera(scene, "equator"));
  scene.merge(R"({"animations": {"fly": {"type": "rate", "target": "equator.position", "rate": [0, 1, 0]}}})", "test");
  EXPECT_TRUE(is_animated_camera(scene, "equator"));
  EXPECT_FALSE(is_animated_camera(scene, "north"));
  EXPECT_EQ(add_camera(scene, scene.description().cameras.front().second), "free");
  EXPECT_EQ(scene.description().head.camera, "free");
  EXPECT_FALSE(is_animated_camera(scene, "free"));
}

}  // namespace
}  // namespace halfspace
