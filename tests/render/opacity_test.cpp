// SPDX-License-Identifier: Apache-2.0
//
// Tests surfaces of a scene that are not opaque.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr const char* kCamera = R"("cameras": {"c": {"type": "orthographic", "position": [0, 0, 5], "target": [0, 0, 0], "height": 2}})";

Image<glm::vec4> light_of(const std::string& text) {
  SceneAssets assets(two_workers());
  const PreparedScene scene = assets.prepare(SceneFile::parse(text, "test", ".").description(), 32, 32);
  Image<glm::vec4> light(32, 32);
  render(scene, light, two_workers());
  return light;
}

std::string wall(const char* name, double z, double color, double opacity) {
  return fmt::format(R"("{}": {{"shape": "plane", "size": 4, "rotation": [90, 0, 0], "position": [0, 0, {}], "shading": "none",
    "color": [{}, {}, {}], "opacity": {}}})",
                     name, z, color, color, color, opacity);
}

// Colors are stored as floats, so the sums differ from the exact ones by a few ulps.
TEST(Opacity, BlendsWithWhatIsBehindInAnyOrder) {
  const std::string back = wall("back", 0, 0.4, 1), middle = wall("middle", 1, 0.8, 0.25), front = wall("front", 2, 0.2, 0.5);
  const double behind_front = 0.25 * 0.8 + 0.75 * 0.4, expected = 0.5 * 0.2 + 0.5 * behind_front;
  for (const std::string& objects : {back + "," + middle + "," + front, front + "," + middle + "," + back}) {
    const std::string text =
        fmt::format(R"({{"version": 1, {}, "objects": {{{}}}, "post": {{"hdr": true, "format": "rgba32f"}}}})", kCamera, objects);
    const Image<glm::vec4> light = light_of(text);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(light.at(16, 16)[k], expected, 1e-6);
  }
}

// A lid of opacity 0.5 covers half of the texels of the shadow map, in a pattern. The 7x7 texels of the filter contain 21 to 28 of 49.
TEST(Opacity, WeightsTheShadow) {
  const std::string text = R"({"version": 1, "cameras": {"c": {"position": [0, 3, 9], "target": [0, 0, 0]}},
    "lights": {"sun": {"direction": [0, 1, 0]}}, "shadow": {"method": "pcf7", "resolution": 512}, "post": {"hdr": true, "format": "rgba32f"},
    "objects": {"floor": {"shape": "plane", "size": 8}, "lid": {"shape": "plane", "size": 6, "position": [0, 6, 0], "opacity": 0.5}}})";
  SceneFile file = SceneFile::parse(text, "test", ".");
  const float half = light_of(file.print()).at(16, 16).x;
  file.set("lid.casts_shadow=false");
  const float full = light_of(file.print()).at(16, 16).x;
  EXPECT_GT(full, 0.0f);
  EXPECT_NEAR(half / full, 0.5f, 0.1f);
}

TEST(Opacity, SpheresAreOpaque) {
  const std::string text = R"({"version": 1, "cameras": {"c": {}}, "objects": {"ball": {"shape": "sphere", "opacity": 0.5}}})";
  EXPECT_THROW(SceneFile::parse(text, "test", ".").at(0.0), InputError);
}

}  // namespace
}  // namespace halfspace
