// SPDX-License-Identifier: Apache-2.0
//
// Frames share shadow maps while nothing changes that the maps depend on. The pictures are those of frames with maps of their own.
#include <gtest/gtest.h>

#include <algorithm>

#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "model/test_meshes.h"

namespace halfspace {
namespace {

using Settings = std::vector<std::string>;

struct ShadowFrame {
  Image<glm::u8vec4> picture{96, 72};
  PassStatistics shadow;
};

// A ground, a globe, an exact sphere and a translucent cube, which all cameras see as a whole.
SceneDescription shadow_scene_with(const Settings& settings) {
  SceneFile file = SceneFile::parse(R"({ "version": 1,
    "cameras": { "main": { "position": [0, 5, 9], "target": [0, 0, 0] } },
    "lights": { "sun": { "direction": [1, 2, 1] } }, "shadow": { "method": "hard", "resolution": 256 },
    "objects": { "ground": { "shape": "plane", "size": 4 },
                 "globe": { "shape": "uv_sphere", "latitudes": 20, "longitudes": 40, "radius": 0.5, "position": [0, 1, 0] },
                 "ball": { "shape": "sphere", "radius": 0.3, "position": [1, 0.5, 0] },
                 "glass": { "shape": "cube", "size": 0.5, "position": [-1, 0.5, 0.5], "opacity": 0.5 } } })",
                                    "test", ".");
  file.set(settings);
  return file.at(0.0);
}

ShadowFrame frame_with(SceneAssets& assets, const Settings& settings, const Workers& workers) {
  ShadowFrame out;
  const PreparedScene scene = assets.prepare(shadow_scene_with(settings), out.picture.width(), out.picture.height());
  out.shadow = scene.shadow_statistics;
  render(scene, out.picture, workers);
  return out;
}

// Compares a frame that may use the maps of earlier ones with a frame of its own.
void expect_own_picture(const ShadowFrame& frame, const Settings& settings, const Workers& workers) {
  SceneAssets own(workers);
  EXPECT_TRUE(std::ranges::equal(frame.picture.texels(), frame_with(own, settings, workers).picture.texels()));
}

class KeptShadowMaps : public testing::Test {
 protected:
  const Workers workers{1};
  SceneAssets assets{workers};
};

TEST_F(KeptShadowMaps, FramesWithOtherCamerasUseThem) {
  for (const char* method : {"hard", "pcf7", "moments"}) {
    const Settings first = {std::string("shadow.method=") + method};
    EXPECT_GT(frame_with(assets, first, workers).shadow.triangles_binned, 0u) << method;
    for (const char* camera : {"main.position=[6, 4, 6]", "main.position=[-8, 5, 2]"}) {
      const Settings later = {first[0], camera};
      const ShadowFrame frame = frame_with(assets, later, workers);
      EXPECT_EQ(frame.shadow, PassStatistics{}) << method << " " << camera;
      expect_own_picture(frame, later, workers);
    }
  }
}

TEST_F(KeptShadowMaps, EveryChangeOfTheLightTheCastersAndTheSettingsDrawsThemAnew) {
  for (const char* change : {"sun.direction=[1, 2, 0]", "shadow.resolution=320", "shadow.faces=back", "shadow.method=pcf7",
                             "globe.position=[0, 1, 0.2]", "globe.latitudes=30", "globe.casts_shadow=false", "ball.position=[1, 0.6, 0]",
                             "ball.radius=0.35", "glass.opacity=0.7", "glass.visible=false", "globe.two_sided=true", "ground.size=5"}) {
    frame_with(assets, {}, workers);
    const ShadowFrame frame = frame_with(assets, {change}, workers);
    EXPECT_GT(frame.shadow.triangles_binned, 0u) << change;
    expect_own_picture(frame, {change}, workers);
  }
}

TEST_F(KeptShadowMaps, MomentsDependOnTheirRadius) {
  frame_with(assets, {"shadow.method=moments", "shadow.radius=2"}, workers);
  const Settings wider = {"shadow.method=moments", "shadow.radius=4"};
  expect_own_picture(frame_with(assets, wider, workers), wider, workers);
}

// The positions of a deformed mesh are made for each frame, possibly at the address of those of the last one.
TEST_F(KeptShadowMaps, AreNotKeptForDeformedMeshes) {
  for (const bool deformed : {false, true}) {
    Model model;
    model.meshes.push_back(sphere(20, 10));
    model.meshes[0].normals = model.meshes[0].positions;
    model.nodes.emplace_back().meshes = {0};
    model.scenes.emplace_back().roots = {0};
    if (deformed) {
      model.meshes[0].targets.push_back({model.meshes[0].positions, {}, {}});
      model.nodes[0].morph_weights = {0.5f};
    }
    SceneAssets own(workers);
    own.add_model("/made/in/memory.obj", std::make_shared<const ModelAsset>(std::move(model)));
    const SceneDescription scene = SceneFile::parse(R"({ "version": 1, "cameras": { "c": { "position": [0, 5, 9], "target": [0, 0, 0] } },
        "lights": { "sun": { "direction": [1, 2, 1] } }, "shadow": { "method": "hard", "resolution": 256 },
        "objects": { "a": { "shape": "file", "file": "/made/in/memory.obj" } } })",
                                                    "test", ".")
                                       .at(0.0);
    EXPECT_GT(own.prepare(scene, 96, 72).shadow_statistics.triangles_binned, 0u);
    EXPECT_EQ(own.prepare(scene, 96, 72).shadow_statistics.triangles_binned > 0, deformed);
  }
}

TEST_F(KeptShadowMaps, AreForgottenOnDemand) {
  frame_with(assets, {}, workers);
  assets.forget_shadow_maps();
  EXPECT_GT(frame_with(assets, {}, workers).shadow.triangles_binned, 0u);
}

}  // namespace
}  // namespace halfspace
