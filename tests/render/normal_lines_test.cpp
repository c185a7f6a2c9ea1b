// SPDX-License-Identifier: Apache-2.0
//
// The key normal_lines: pictures with known pixels, counters of the geometry stage, and keys that exclude it.
#include <gtest/gtest.h>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/errors.h"

namespace halfspace {
namespace {

// A horizontal square is seen from its side, so nothing of its surface is visible. A unit is 16 pixels. Its corners are in the middle of
// columns 16 and 48; at each, two lines cover the same pixels, because a corner in front hides the one behind it.
SceneFile square(const std::string& keys) {
  return SceneFile::parse(R"({"version": 1, "ambient": 1,
    "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "height": 4}},
    "objects": {"a": {"shape": "plane", "size": 2, "position": [0.03125, 0, 0])" +
                              keys + "}}}",
                          "test.json", {});
}

struct Rendered {
  Image<glm::vec4> light{64, 64};
  Image<uint32_t> object{64, 64};
  PassStatistics statistics;
};
Rendered render_square(const std::string& keys) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene scene = assets.prepare(square(keys).at(0), 64, 64);
  Rendered out;
  out.statistics = render(scene, out.light, workers);
  render_frame(scene, {.object = &out.object}, workers);
  return out;
}

bool is_at_corner(int x) { return x == 16 || x == 48; }

TEST(NormalLines, CoverTheirPixelsInTheColorOfTheNormal) {
  // The transforms leave the normal (0, 1, 0) and the length in scene units.
  for (const char* keys :
       {R"(, "normal_lines": 0.5)", R"(, "normal_lines": 0.5, "scale": [1, 7, 3])", R"(, "normal_lines": 0.5, "rotation": [0, 180, 0])"}) {
    const Rendered r = render_square(keys);
    for (int row = 0; row < 64; ++row) {
      for (int x = 0; x < 64; ++x) {
        const bool covered = is_at_corner(x) && row >= 24 && row < 32;  // 0.5 units above the middle
        EXPECT_EQ(r.light.at(x, row), covered ? glm::vec4(0.5f, 1.0f, 0.5f, 1.0f) : glm::vec4(0, 0, 0, 1)) << x << ' ' << row << keys;
        EXPECT_EQ(r.object.at(x, row), kNoId) << "lines of normals are not surfaces";
      }
    }
    EXPECT_EQ(r.statistics.geometry_invocations, 2u) << "once per triangle";
    EXPECT_EQ(r.statistics.primitives_in, 2u + 6u) << "two triangles, and three lines for each";
  }
}

TEST(NormalLines, CostNothingWithoutTheKey) {
  const Rendered r = render_square("");
  EXPECT_EQ(r.statistics.geometry_invocations, 0u);
  EXPECT_EQ(r.statistics.primitives_in, 2u);
  EXPECT_EQ(r.statistics.vertices_shaded, 4u);
}

TEST(NormalLines, AreHiddenBySurfaces) {
  const Workers workers(1);
  SceneAssets assets(workers);
  SceneFile scene = square(R"(, "normal_lines": 0.5}, "wall": {"shape": "cube", "shading": "none", "position": [-1, 0, 5])");
  Image<glm::vec4> light(64, 64);
  render(assets.prepare(scene.at(0), 64, 64), light, workers);
  EXPECT_EQ(light.at(16, 28), glm::vec4(1.0f)) << "behind the cube";
  EXPECT_EQ(light.at(48, 28), glm::vec4(0.5f, 1.0f, 0.5f, 1.0f));
}

TEST(NormalLines, NeedAMesh) {
  EXPECT_TRUE(reports(
      input_error([] { SceneFile::parse(R"({"version": 1, "objects": {"a": {"shape": "sphere", "normal_lines": 1}}})", "test.json", {}); }),
      "test.json: objects.a.normal_lines", {"sphere", "normals", "uv_sphere"}));
}

}  // namespace
}  // namespace halfspace
