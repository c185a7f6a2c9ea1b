// SPDX-License-Identifier: Apache-2.0
//
// Tests objects of shape "sphere": they are placed, lit and shadowed like meshes, and reject keys that need a mesh.
#include <gtest/gtest.h>

#include "halfspace/core/check.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/errors.h"

namespace halfspace {
namespace {

constexpr int kBallWidth = 320, kBallHeight = 200;

SceneDescription scene_of(const std::string& sections) {
  return SceneFile::parse(R"({"version": 1, "ambient": 0.1, "cameras": {"c": {"position": [0, 1, 6], "fov": 45}},
                              "lights": {"sun": {"direction": [1, 1, 1]}, "lamp": {"type": "point", "position": [-3, 2, 2]}}, )" +
                              sections + "}",
                          "test", ".")
      .description();
}

Image<glm::u8vec4> ball_picture(const std::string& sections) {
  static const Workers team(2);
  SceneAssets assets(team);
  Image<glm::u8vec4> picture(kBallWidth, kBallHeight);
  render(assets.prepare(scene_of(sections), kBallWidth, kBallHeight), picture, team);
  return picture;
}

// Tests every factor, light model and kind of placement, on a floor that receives shadows. A band of the finest mesh is 0.3 px high, so its
// outline is accurate to 1e-3 px and its normals to 2e-5. Only pixels on the outlines of the sphere and its shadow can differ. These are
// about 1,000 px long, so one pixel is expected to differ, which agrees with the measurement. Some values differ by 1/255 because of
// rounding ties.
TEST(ExactSphere, MatchesTheFinestMesh) {
  const std::string floor = R"("floor": {"shape": "plane", "size": 12, "position": [0, -1, 0]})";
  for (const std::string look : {R"("specular": 0.6, "shininess": 12, "model": "phong")", R"("specular": [0.6, 0.2, 0], "shininess": 60)",
                                 R"("color": [0.2, 0.5, 0.9], "tint": 0.7, "diffuse": 0.8, "ambient": 2)", R"("emissive": [0.1, 0, 0.2])",
                                 R"("casts_shadow": false)", R"("receives_shadow": false)"}) {
    for (const std::string place : {R"("radius": 0.5, "position": [0.4, 0.2, 1], "rotation": [10, 20, 30], "scale": [2, 2, -2])",
                                    R"("instances": [{"position": [-1, 0, 0]}, {"position": [1, 0.5, 0], "scale": [0.5, 0.5, 0.5]}])"}) {
      const auto with = [&](const std::string& shape) {
        return ball_picture(R"("shadow": {"method": "bilinear"}, "objects": {)" + floor + R"(, "ball": {"shape": )" + shape + ", " + look +
                            ", " + place + "}}");
      };
      const ImageDifference d = compare_images(with(R"("uv_sphere", "latitudes": 512, "longitudes": 1024)"), with(R"("sphere")"));
      EXPECT_LE(d.share_above * kBallWidth * kBallHeight, 4.5) << look << place;
      EXPECT_LT(d.mean, 2e-5) << look << place;
    }
  }
}

// An ignored factor would go unnoticed at its default value. A highlight covers about a hundred pixels.
TEST(ExactSphere, UsesEveryFactorOfItsMaterial) {
  const auto with = [](const std::string& look) { return ball_picture(R"("objects": {"ball": {"shape": "sphere")" + look + "}}"); };
  const auto is_other = [&](const std::string& a, const std::string& b) { return compare_images(with(a), with(b)).share_above > 0.001; };
  for (const std::string look : {R"(, "color": [1, 0.5, 0.5])", R"(, "tint": 0.5)", R"(, "ambient": 0)", R"(, "diffuse": 0.5)",
                                 R"(, "specular": 0.5)", R"(, "emissive": 0.2)"}) {
    EXPECT_TRUE(is_other("", look)) << look;
  }
  const std::string shiny = R"(, "specular": 0.5)";
  EXPECT_TRUE(is_other(shiny, shiny + R"(, "shininess": 4)"));
  EXPECT_TRUE(is_other(shiny, shiny + R"(, "model": "phong")"));
  EXPECT_FALSE(is_other("", R"(, "model": "phong", "shininess": 4)")) << "without a highlight, model and shininess have no effect";
}

TEST(ExactSphere, RejectsKeysThatNeedAMesh) {
  const struct {
    const char *keys, *key;
  } cases[] = {{R"("color": "t")", "color"},
               {R"("diffuse_map": "t")", "diffuse_map"},
               {R"("specular_map": "t")", "specular_map"},
               {R"("ambient_map": "t")", "ambient_map"},
               {R"("shininess_map": "t")", "shininess_map"},
               {R"("emissive_map": "t")", "emissive_map"},
               {R"("normal_map": "t")", "normal_map"},
               {R"("bump_map": "t")", "bump_map"},
               {R"("height": "t")", "height"},
               {R"("reflection": 0.5)", "reflection"},
               {R"("shading": "flat")", "shading"},
               {R"("two_sided": true)", "two_sided"},
               {R"("scale": [1, 1, 2])", "scale"},
               {R"("instances": [{}, {"scale": [1, 3, 1]}])", "instances"}};
  for (const auto& c : cases) {
    const std::string ball = R"("textures": {"t": {"source": "checkerboard"}}, "objects": {"ball": {"shape": "sphere", )";
    EXPECT_TRUE(reports(input_error([&] { scene_of(ball + c.keys + "}}"); }), "test: objects.ball." + std::string(c.key),
                        {"shape sphere", "uv_sphere", "icosphere"}));
  }
}

}  // namespace
}  // namespace halfspace
