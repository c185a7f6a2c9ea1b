// SPDX-License-Identifier: Apache-2.0
//
// Tests the lists of lights per cell of the window, and that a light outside of the picture costs neither a shadow map nor shading.
#include "halfspace/render/prepare/light_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "halfspace/core/trig_double.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/light/lighting.h"

namespace halfspace {
namespace {

View view_of(bool orthographic, int width, int height) {
  CameraDescription camera;
  camera.position = {2, 3, 9};
  camera.target = {0, 0.5, 0};
  camera.fov = 60.0;
  camera.near = 0.1;
  camera.far = 100.0;
  if (orthographic) {
    camera.type = Projection::orthographic;
    camera.height = 8.0;
  }
  return make_view(camera, width, height);
}

// A point or spot light at a random place. Some have no range, and some are behind the eye.
Light random_light(std::mt19937& random) {
  std::uniform_real_distribution<float> place(-12.0f, 12.0f), unit(0.0f, 1.0f);
  Light light;
  light.type = unit(random) < 0.5f ? LightType::point : LightType::spot;
  light.position_rws = {place(random), place(random), place(random)};
  const glm::vec3 axis(place(random), place(random), place(random));
  light.axis_ws = axis / std::sqrt(glm::dot(axis, axis));
  light.cos_outer = static_cast<float>(sincos_turns(static_cast<double>(unit(random)) * 0.5).cos);
  light.cone_scale = 1.0f;
  light.inverse_range = unit(random) < 0.8f ? 1.0f / (0.1f + 4.0f * unit(random)) : 0.0f;
  return light;
}

std::set<const Light*> listed(const LightSet& set, const glm::vec2& pixel) {
  std::set<const Light*> found;
  for (const Light& light : set.at_pixel(pixel.x, pixel.y)) found.insert(&light);
  return found;
}

TEST(LightCells, ContainEveryLightThatReachesAVisiblePoint) {
  std::mt19937 random(1);
  int reached = 0, omitted = 0;
  for (const bool orthographic : {false, true}) {
    const View view = view_of(orthographic, 300, 200);
    std::vector<Light> lights;
    for (int i = 0; i < 60; ++i) lights.push_back(random_light(random));
    const auto cells = light_cells(view, lights);
    ASSERT_NE(cells, nullptr);
    const LightSet set(lights, cells.get());
    const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 5000; ++i) {
      const glm::vec2 pixel(300.0f * unit(random), 200.0f * unit(random));
      const double z = std::pow(static_cast<double>(unit(random)), 3.0);  // most points are far from the near plane
      const glm::dvec4 p =
          world_from_clip * glm::dvec4(static_cast<double>(pixel.x) / 150.0 - 1.0, static_cast<double>(pixel.y) / 100.0 - 1.0, z, 1.0);
      const vec3<float> position_rws(glm::vec3(glm::dvec3(p) / p.w - view.eye_ws));
      const std::set<const Light*> here = listed(set, pixel);
      omitted += static_cast<int>(lights.size() - here.size());
      for (const Light& light : lights) {
        if (!(light_at(light, position_rws).strength > 0.0f)) continue;
        ++reached;
        EXPECT_TRUE(here.contains(&light)) << "light " << &light - lights.data() << " at pixel " << pixel.x << ", " << pixel.y;
      }
    }
  }
  EXPECT_GT(reached, 10000);
  EXPECT_GT(omitted, 100000);  // of 600,000 pairs of a light and a point
}

// A small ball around the middle of a cell is seen in that cell only.
TEST(LightCells, OmitLightsThatReachOtherCellsOnly) {
  const View view = view_of(false, 320, 192);  // 5 x 3 cells
  std::vector<Light> lights;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 5; ++column) {
      const double x = (column + 0.5) / 2.5 - 1.0, y = (row + 0.5) / 1.5 - 1.0;
      Light light;
      light.type = LightType::point;
      light.position_rws = glm::vec3(5.0 * (view.ray_ws + x * view.ray_x_ws + y * view.ray_y_ws));
      light.inverse_range = 1.0f / 0.3f;  // a cell is more than one unit wide at this distance
      lights.push_back(light);
    }
  }
  const auto cells = light_cells(view, lights);
  ASSERT_NE(cells, nullptr);
  const LightSet set(lights, cells.get());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const glm::vec2 pixel(64.0f * static_cast<float>(i % 5) + 1.0f, 64.0f * static_cast<float>(i / 5) + 63.0f);
    EXPECT_EQ(listed(set, pixel), std::set<const Light*>{&lights[i]}) << "cell " << i;
  }
}

TEST(LightCells, AreNotMadeForFewLightsOfLimitedReach) {
  const View view = view_of(false, 320, 192);
  std::vector<Light> lights(100);  // directional
  EXPECT_EQ(light_cells(view, lights), nullptr);
  for (std::size_t i = 0; i < kManyLights; ++i) {
    EXPECT_EQ(light_cells(view, lights), nullptr);
    lights[i].type = LightType::point;
    lights[i].inverse_range = 1.0f;
  }
  EXPECT_NE(light_cells(view, lights), nullptr);
}

// A plane and a ball with three lights. With `far_lights`, there are also many lights that do not reach anything visible.
std::string scene_text(bool far_lights) {
  std::string lights = R"("sun": { "direction": [1, 2, 1], "intensity": 0.3 },
    "lamp": { "type": "point", "position": [1, 1, 1], "range": 3 },
    "spot": { "type": "spot", "position": [-1, 3, 0], "direction": [0, 1, 0], "range": 5, "inner": 10, "outer": 25 })";
  for (int i = 0; far_lights && i < 40; ++i)
    lights +=
        ", \"far" + std::to_string(i) + R"(": { "type": "point", "position": [)" + std::to_string(100 + i) + ", 0, 0], \"range\": 20 }";
  return R"({ "version": 1, "cameras": { "main": { "position": [0, 2, 5], "target": [0, 0, 0], "far": 20 } },
    "lights": { )" +
         lights + R"( },
    "objects": { "ground": { "shape": "plane", "size": 8, "shading": "phong" },
                 "ball": { "shape": "uv_sphere", "radius": 0.5, "position": [0, 0.5, 0], "shading": "phong" } },
    "shadow": { "method": "pcf3", "resolution": 256 } })";
}

TEST(LightCells, LightsOutsideOfThePictureCostNothingAndChangeNothing) {
  static const Workers workers(2);
  const auto render_scene = [](bool far_lights, PassStatistics& shadows) {
    SceneAssets assets(workers);
    const PreparedScene scene = assets.prepare(SceneFile::parse(scene_text(far_lights), "test", ".").at(0.0), 160, 100);
    shadows = scene.shadow_statistics;
    Image<glm::u8vec4> picture(160, 100);
    render(scene, picture, workers);
    return picture;
  };
  PassStatistics few, many;
  const Image<glm::u8vec4> expected = render_scene(false, few), found = render_scene(true, many);
  EXPECT_TRUE(std::ranges::equal(expected.texels(), found.texels()));
  EXPECT_EQ(few, many);  // no shadow map is rendered for the other lights
}

}  // namespace
}  // namespace halfspace
