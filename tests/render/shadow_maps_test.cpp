// SPDX-License-Identifier: Apache-2.0
//
// Tests the contents of a scene's shadow maps, and the cost of rendering them.
#include <gtest/gtest.h>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace {
namespace {

// A cube from y = 1 to y = 2 above a plane at y = 0, lit from straight above.
PreparedScene prepared(const std::vector<std::string>& settings) {
  SceneFile file = SceneFile::parse(R"({ "version": 1,
    "cameras": { "main": { "position": [0, 4, 8], "target": [0, 0, 0] } },
    "lights": { "sun": { "direction": [0, 1, 0] } },
    "objects": { "ground": { "shape": "plane", "size": 10 }, "cube": { "shape": "cube", "size": 1, "position": [0, 1.5, 0] } },
    "shadow": { "method": "hard", "resolution": 256 } })",
                                    "test", ".");
  file.set(settings);
  static const Workers workers(2);
  SceneAssets assets(workers);
  return assets.prepare(file.at(0.0), 160, 90);
}

// Returns the height of the surface that the light sees near the middle of the ground.
double height_seen(const PreparedScene& scene) {
  const ShadowView& view = scene.lights.front().light.shadow->views.front();
  const auto depth_at = [&](double y) {
    return shadow_coordinates(view, vec3<float>(glm::vec3(glm::dvec3(0.1, y, 0.1) - scene.view.eye_ws)));
  };
  const ShadowCoordinates<float> low = depth_at(0.0), high = depth_at(2.0);
  const float seen = map_depth<float>(view, static_cast<int32_t>(low.x), static_cast<int32_t>(low.y));
  return 2.0 * static_cast<double>((seen - low.depth) / (high.depth - low.depth));
}

TEST(ShadowMaps, ContainTheSelectedFaces) {
  EXPECT_NEAR(height_seen(prepared({})), 2.0, 1e-4);  // float depths over a range of about 4 units
  EXPECT_NEAR(height_seen(prepared({"shadow.faces=back"})), 1.0, 1e-4);
  EXPECT_NEAR(height_seen(prepared({"shadow.faces=both"})), 2.0, 1e-4);
}

TEST(ShadowMaps, ContainOnlyCasters) {
  EXPECT_NEAR(height_seen(prepared({"cube.casts_shadow=false"})), 0.0, 1e-4);
  EXPECT_NEAR(height_seen(prepared({"cube.visible=false"})), 0.0, 1e-4);
  EXPECT_EQ(prepared({"sun.shadow=false"}).lights.front().light.shadow, nullptr);
}

TEST(ShadowMaps, ShadeNoFragments) {
  const PassStatistics made = prepared({}).shadow_statistics;
  EXPECT_GT(made.triangles_binned, 0u);
  EXPECT_GT(made.samples_passed, 10000u);  // samples of the plane and the cube
  EXPECT_EQ(made.fragments_shaded, 0u);
  const PassStatistics none = prepared({"shadow.method=none"}).shadow_statistics;
  EXPECT_EQ(none, PassStatistics{});  // no shadow pass runs
}

}  // namespace
}  // namespace halfspace
