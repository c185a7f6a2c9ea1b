// SPDX-License-Identifier: Apache-2.0
//
// Keys that have no effect, and the ranges in messages about values.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_file.h"
#include "support/errors.h"

namespace halfspace {
namespace {

SceneFile scene_with(const std::string& rest) { return SceneFile::parse("{\"version\": 1, " + rest + "}", "test.json", "/somewhere"); }

std::string object_of_model(const std::string& keys) { return R"("objects": {"a": {"shape": "file", "file": "a.obj")" + keys + "}}"; }

// ---- models ------------------------------------------------------------------------------------------------------

TEST(Effect, ModelsWithTheirOwnMaterialsRejectSurfaceKeys) {
  for (const char* setting : {"color=#804020", "color=a.png", "tint=0.5", "diffuse=0.5", "emissive=1", "reflection=0.5", "normal_map=n.png",
                              "bump_map=b.png", "two_sided=true", "shininess=7", "model=phong"}) {
    SceneFile scene = scene_with(object_of_model(""));
    const std::string text = setting, key = text.substr(0, text.find('='));
    EXPECT_TRUE(reports(input_error([&] { scene.set("a." + text); }), "test.json: objects.a." + key,
                        {"no effect", "own materials", "expected", "material"}))
        << setting;
  }
  EXPECT_EQ(
      input_error([] { scene_with(object_of_model(R"(, "color": [0, 1, 0])")); }),
      "test.json: objects.a.color: has no effect on a model with its own materials; expected the key material as well, or no such key");
}

TEST(Effect, ModelsWithTheirOwnMaterialsAreLitPerPixelOrNotAtAll) {
  for (const char* setting : {"shading=flat", "shading=gouraud", "normal=map", "normal=bump"}) {
    SceneFile scene = scene_with(object_of_model(""));
    const std::string text = setting, key = text.substr(0, text.find('='));
    EXPECT_TRUE(reports(input_error([&] { scene.set("a." + text); }), "test.json: objects.a." + key, {"own materials", "expected", "none"}))
        << setting;
  }
}

// Height maps displace only shapes of the scene.
TEST(Effect, ModelsRejectHeightMaps) {
  const std::string material = R"("materials": {"m": {}}, )";
  for (const char* keys : {R"(, "height": "h.png")", R"(, "material": "m", "height": "h.png")"})
    EXPECT_TRUE(
        reports(input_error([&] { scene_with(material + object_of_model(keys)); }), "test.json: objects.a.height", {"no effect", "shape"}));
  EXPECT_TRUE(reports(input_error([&] { scene_with(object_of_model(R"(, "height_scale": 2)")); }), "test.json: objects.a.height_scale",
                      {"no effect"}));
}

TEST(Effect, ModelsAcceptAllOtherKeys) {
  SceneFile scene = scene_with(object_of_model(R"(, "instances": [{}])"));
  const std::vector<std::string> settings{"a.visible=false",
                                          "a.casts_shadow=false",
                                          "a.receives_shadow=false",
                                          "a.position=1,2,3",
                                          "a.rotation=0,90,0",
                                          "a.scale=2,2,2",
                                          "a.up_axis=z",
                                          "a.model_time=1",
                                          "a.model_error=0.5",
                                          "a.color=1",
                                          "a.shading=phong",
                                          "a.shading=none",
                                          "a.normal=none",
                                          "a.textured=false",
                                          "a.normal_lines=0.5",
                                          "a.instances.0.position=1,0,0"};
  EXPECT_EQ(input_error([&] { scene.set(settings); }), "(no error)");
  EXPECT_EQ(SceneFile::parse(scene.print(), "test.json", "/").print(), scene.print()) << "printed scenes contain all keys";
}

TEST(Effect, SurfaceKeysOfAModelOverrideItsMaterial) {
  SceneFile scene = scene_with(R"("materials": {"m": {"shininess": 7}}, )" + object_of_model(R"(, "material": "m", "color": [0, 1, 0])"));
  scene.set("a.shading=flat");
  EXPECT_EQ(scene.description().objects[0].second.surface.shading, ShadingRate::flat);
  EXPECT_TRUE(reports(input_error([&] { scene.set("a.material="); }), "test.json: objects.a.", {"own materials", "material as well"}));
}

TEST(Effect, AnimationsOfKeysWithoutEffectAreRejected) {
  const auto animated = [](const std::string& keys, const std::string& target, const std::string& rate) {
    return R"("materials": {"m": {}}, )" + object_of_model(keys) + R"(, "animations": {"t": {"target": ")" + target + R"(", "rate": )" +
           rate + "}}";
  };
  EXPECT_TRUE(reports(input_error([&] { scene_with(animated("", "a.tint", "[1, 1, 1]")); }), "test.json: animations.t.target: a.tint",
                      {"no effect", "own materials"}));
  EXPECT_EQ(input_error([&] { scene_with(animated(R"(, "material": "m")", "a.tint", "[1, 1, 1]")); }), "(no error)");
  EXPECT_EQ(input_error([&] { scene_with(animated("", "a.position", "[1, 1, 1]")); }), "(no error)");
}

// An object that becomes a model loses the keys that would have no effect, like those that models do not have.
TEST(Effect, ChangingTheShapeToAModelDropsSurfaceKeys) {
  SceneFile scene = scene_with(R"("objects": {"a": {"latitudes": 8, "color": [0, 1, 0], "height_scale": 2, "visible": false}})");
  EXPECT_EQ(input_error([&] { scene.set(std::vector<std::string>{"a.shape=file", "a.file=a.obj"}); }), "(no error)");
  EXPECT_FALSE(scene.description().objects[0].second.visible);
  SceneFile with_material =
      scene_with(R"("materials": {"m": {}}, "objects": {"a": {"latitudes": 8, "material": "m", "color": [0, 1, 0]}})");
  with_material.set(std::vector<std::string>{"a.shape=file", "a.file=a.obj"});
  EXPECT_EQ(std::get<Color>(with_material.description().objects[0].second.surface.color).linear, glm::dvec3(0, 1, 0));
}

// ---- cameras -----------------------------------------------------------------------------------------------------

TEST(Effect, CameraErrorsNameTheCause) {
  const auto error = [](const std::string& keys) { return input_error([&] { scene_with(R"("cameras": {"c": {)" + keys + "}}"); }); };
  EXPECT_TRUE(reports(error(R"("position": [1, 2, 3], "target": [1, 2, 3])"), "test.json: cameras.c.target", {"equals position", "point"}));
  EXPECT_TRUE(reports(error(R"("up": [0, 0, 0])"), "test.json: cameras.c.up", {"is zero", "direction"}));
  EXPECT_TRUE(reports(error(R"("up": [0, 0, 3])"), "test.json: cameras.c.up", {"parallel", "position", "target"}));
  EXPECT_EQ(error(R"("position": [0, 0, 1e-300])"), "(no error)");
}

// ---- ranges ------------------------------------------------------------------------------------------------------

TEST(Effect, MessagesStateBothBounds) {
  SceneFile scene = scene_with(R"("objects": {"a": {}}, "lights": {"l": {}}, "animations": {"t": {"target": "a.radius"}})");
  const auto error = [&](const char* setting) { return input_error([&] { scene.set(setting); }); };
  EXPECT_EQ(error("l.intensity=1e30"), "--set: l.intensity: expected a number from 0 to 1e+09, got 1e+30");
  EXPECT_EQ(error("a.radius=2e6"), "--set: a.radius: expected a number from 1e-06 to 1e+06 (units), got 2e+06");
  EXPECT_EQ(error("particles.count=2000000"), "--set: particles.count: expected an integer from 0 to 1000000, got 2000000");
  EXPECT_EQ(error("a.shininess=2e5"), "--set: a.shininess: expected a number from 0 to 100000, got 2e+05");
  EXPECT_TRUE(reports(error("a.position=1e10,0,0"), "--set: a.position", {"from -1e+09 to 1e+09 (units)", "10000000000"}));
  EXPECT_TRUE(reports(error("ambient=-1"), "--set: ambient", {"from 0 to 1e+09", "got -1"}));
  EXPECT_TRUE(reports(error("a.color=-1"), "--set: a.color", {"from 0 to 1e+09", "texture", "got -1"}));
  EXPECT_TRUE(reports(error("t.rate=1e10"), "--set: t.rate", {"from -1e+09 to 1e+09"}));
}

}  // namespace
}  // namespace halfspace
