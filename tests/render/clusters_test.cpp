// SPDX-License-Identifier: Apache-2.0
//
// Large meshes have clusters from the second frame on that draws them. They do not change the picture.
#include <gtest/gtest.h>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {
namespace {

constexpr int kClusterWidth = 96, kClusterHeight = 72;

struct ClusterFrame {
  Image<glm::u8vec4> picture{kClusterWidth, kClusterHeight};
  PassStatistics color, shadow;
};

ClusterFrame frame_of(SceneAssets& assets, const std::vector<std::string>& settings, const Workers& workers) {
  SceneFile file = SceneFile::parse(R"({ "version": 1,
    "cameras": { "main": { "position": [0, 3, 6], "target": [0, 0, 0] } },
    "lights": { "sun": { "direction": [1, 2, 1] } }, "shadow": { "faces": "front" },
    "objects": { "ground": { "shape": "plane", "size": 8 },
                 "globe": { "shape": "uv_sphere", "latitudes": 100, "longitudes": 400, "position": [0, 1, 0] } } })",
                                    "test", ".");
  file.set(settings);
  const PreparedScene scene = assets.prepare(file.at(0.0), kClusterWidth, kClusterHeight);
  ClusterFrame out;
  out.shadow = scene.shadow_statistics;
  out.color = render(scene, out.picture, workers);
  return out;
}

TEST(SceneClusters, MeshesThatAreDrawnAgainSkipTriangles) {
  const Workers workers(1);
  SceneAssets assets(workers);
  const ClusterFrame first = frame_of(assets, {}, workers);
  EXPECT_EQ(first.color.culled_cluster + first.shadow.culled_cluster, 0u);
  for (const char* position : {"main.position=[0, 3, 6]", "main.position=[4, 1, 4]", "main.position=[0, 1, 0.5]"}) {
    const ClusterFrame again = frame_of(assets, {position}, workers);
    SceneAssets others(workers);
    const ClusterFrame alone = frame_of(others, {position}, workers);
    EXPECT_GT(again.color.culled_cluster, 10000u) << position;  // of 79,200, which are little larger than the grid of the window
    EXPECT_LT(again.color.vertices_shaded, alone.color.vertices_shaded) << position;
    EXPECT_EQ(again.color.triangles_binned, alone.color.triangles_binned) << position;
    EXPECT_TRUE(std::ranges::equal(again.picture.texels(), alone.picture.texels())) << position;
  }
}

}  // namespace
}  // namespace halfspace
