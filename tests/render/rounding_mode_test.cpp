// SPDX-License-Identifier: Apache-2.0
//
// Tests that the rounding mode of the host program has no effect on pictures, and that the library restores it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>

#include "halfspace/model/model.h"
#include "halfspace/render/model_file/model_scene.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

class RoundingMode {
 public:
  explicit RoundingMode(int mode) : saved_(std::fegetround()) { std::fesetround(mode); }
  ~RoundingMode() { std::fesetround(saved_); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;

 private:
  int saved_;
};

Image<glm::u8vec4> picture_of(const SceneFile& file) {
  const Workers workers(2);
  SceneAssets assets(workers);
  Image<glm::u8vec4> picture(96, 54);
  render(assets.prepare(file.at(0.3), picture.width(), picture.height()), picture, workers);
  return picture;
}

TEST(RoundingMode, HasNoEffectOnShippedScenes) {
  for (const ShippedScene& scene : shipped_scenes()) {
    const std::string name(scene.name);
    const Image<glm::u8vec4> expected = picture_of(SceneFile::open(name));
    const RoundingMode mode(FE_UPWARD);
    const Image<glm::u8vec4> actual = picture_of(SceneFile::open(name));
    EXPECT_EQ(std::fegetround(), FE_UPWARD) << name;
    EXPECT_TRUE(std::ranges::equal(expected.texels(), actual.texels())) << name;
  }
}

TEST(RoundingMode, HasNoEffectOnModels) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "model.obj";
  write_bytes(file, "v 0.1 0.2 0.3\nv 1.1 0.7 0.123456789\nv 0.9 1.3 -0.1\nv 0.3 0.3 1.7\nf 1 2 3\nf 1 3 4\nf 2 3 4\n");
  const Model expected = read_model(file);
  ModelView view;
  view.yaw = 31.0;
  const std::string expected_scene = model_scene(file, view).text;
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const RoundingMode mode(rounding);
    const Model actual = read_model(file);
    EXPECT_EQ(std::fegetround(), rounding);
    EXPECT_EQ(expected.meshes.at(0).positions, actual.meshes.at(0).positions);
    EXPECT_EQ(expected.meshes.at(0).normals, actual.meshes.at(0).normals);
    EXPECT_EQ(expected_scene, model_scene(file, view).text);
    EXPECT_EQ(std::fegetround(), rounding);
  }
}

}  // namespace
}  // namespace halfspace
