// SPDX-License-Identifier: Apache-2.0
//
// Tests the procedural skies as environments of scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/values/tone.h"
#include "render/naive_picture.h"

namespace halfspace {
namespace {

SceneDescription sky_with(const std::vector<std::string>& settings) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "cameras": {"c": {"position": [0, 0, 0], "target": [0, 0.4, -1], "fov": 60}},
    "environments": {"day": {"type": "day_sky", "sun": [0, 0.4, -1], "size": 128}, "night": {"type": "night_sky", "size": 64}},
    "background": {"type": "environment", "environment": "day", "second": "night"}})",
                                     "test.json", ".");
  scene.set(settings);
  return scene.description();
}

TEST(SkyScene, SunIsInTheGivenDirection) {
  for (const char* rotation : {"day.rotation=0,0,0", "day.rotation=0,70,0"}) {
    const Image<glm::vec4> image = light_of(sky_with({rotation}), 65, 65);
    EXPECT_GT(luminance(vec3<float>(glm::vec3(image.at(32, 32)))), 10.0f) << "the sun is at the center for any rotation of the clouds";
    EXPECT_LT(luminance(vec3<float>(glm::vec3(image.at(8, 8)))), 3.0f);
  }
}

TEST(SkyScene, StarsFadeWithTheNightSky) {
  const auto brightest = [](const std::vector<std::string>& settings) {
    const Image<glm::vec4> image = light_of(sky_with(settings), 320, 200);
    float max_luminance = 0;
    for (const glm::vec4& c : image.texels()) max_luminance = std::max(max_luminance, luminance(vec3<float>(glm::vec3(c))));
    return max_luminance;
  };
  EXPECT_GT(brightest({"background.weight=1", "night.star_brightness=50"}), 5.0f);
  EXPECT_LT(brightest({"background.weight=1", "night.stars=0"}), 0.02f);
  const float half = brightest({"background.weight=0.5", "day.brightness=0", "night.star_brightness=50"});
  EXPECT_NEAR(half, 0.5f * brightest({"background.weight=1", "night.star_brightness=50"}), 0.01f * half);
  EXPECT_GT(brightest({"background.environment=night", "background.weight=0", "night.star_brightness=50"}), 5.0f)
      << "also as the first environment";
}

TEST(SkyScene, IsWithinOneLsbOfDoublePrecision) {
  for (const char* weight : {"background.weight=0", "background.weight=0.6", "background.weight=1"}) {
    // The exceptions are rims of stars and rounding ties. The limit is the same as for the scene "moon".
    EXPECT_LE(share_beyond_one_code<double>(sky_with({weight}), 160, 90), 1e-3) << weight;
  }
}

TEST(SkyScene, ResolutionFollowsTheView) {
  const auto size_of = [](int height) {
    const Workers workers(2);
    SceneAssets assets(workers);
    const PreparedScene scene = assets.prepare(sky_with({"day.size=0", "day.clouds=0"}), height, height);
    return std::get<EnvironmentSky>(scene.draws.back().shader).environment.first.map->width();
  };
  // A pixel at the center spans 2 tan 30° / height. A texel at the center of a face spans 2 / size, and may span at most two pixels.
  EXPECT_EQ(size_of(50), 64);
  EXPECT_EQ(size_of(100), 128);
  EXPECT_EQ(size_of(200), 256);
}

TEST(SkyScene, ExpectedFramesShareOneResolution) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const auto size_of = [&](const char* fov) {
    const PreparedScene scene = assets.prepare(sky_with({"day.size=0", "day.clouds=0", fov}), 100, 100);
    return std::get<EnvironmentSky>(scene.draws.back().shader).environment.first.map->width();
  };
  EXPECT_EQ(size_of("c.fov=60"), 128);
  assets.expect(sky_with({"c.fov=30"}), 100, 100);  // a pixel spans half the angle
  EXPECT_EQ(size_of("c.fov=60"), 256);
  EXPECT_EQ(size_of("c.fov=30"), 256);
}

}  // namespace
}  // namespace halfspace
