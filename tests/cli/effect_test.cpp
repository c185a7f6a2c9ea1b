// SPDX-License-Identifier: Apache-2.0
//
// Options, keys and cameras that would have no effect or show nothing.
#include <fstream>
#include <string>
#include <vector>

#include "cli/cli_run.h"
#include "support/errors.h"

namespace halfspace {
namespace {

class Effects : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("a.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    write("mixed.json",
          scene(R"("a": {"shape": "file", "file": "a.obj"}, "b": {"latitudes": 8, "longitudes": 16, "position": [1, 0, 0]})"));
    write("red.json", scene(R"("a": {"shape": "file", "file": "a.obj", "material": "red"})"));
    write("model.json", scene(R"("a": {"shape": "file", "file": "a.obj"})"));
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  static std::string scene(const std::string& objects) {
    return R"({"version": 1, "cameras": {"c": {"position": [0, 0, 4]}}, "lights": {"l": {"direction": [1, 1, 1]}},
      "materials": {"red": {"color": "#c02020"}}, "objects": {)" +
           objects + "}}";
  }
  Outcome render(std::vector<std::string> words) const {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--size", "32x18", "-o", "a.png"});
    return run(words);
  }
  // Renders a picture without a message.
  Image<glm::u8vec4> picture_of(const std::vector<std::string>& words) const {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    return picture("a.png");
  }
  // Runs a command that must fail, and checks its message.
  testing::AssertionResult fails(const std::vector<std::string>& words, int exit_code, const std::string& place,
                                 const std::vector<std::string>& keywords) const {
    const Outcome o = render(words);
    if (o.exit_code != exit_code || !o.err.ends_with("\n")) return testing::AssertionFailure() << o.exit_code << ": " << o.err;
    return reports(o.err.substr(0, o.err.size() - 1), "halfspace: " + place, keywords);
  }
  // Renders a picture with one warning, and checks it.
  testing::AssertionResult warns(const std::vector<std::string>& words, const std::string& place,
                                 const std::vector<std::string>& keywords) const {
    return fails(words, 0, "warning: " + place, keywords);
  }
};

TEST_F(Effects, ShadingIsRefusedIfThereAreOnlyModelsWithTheirOwnMaterials) {
  for (const char* scene : {"a.obj", "model.json"})
    EXPECT_TRUE(fails({scene, "--shading", "flat"}, 2, "--shading", {"no effect", "model", "material"})) << scene;
  EXPECT_TRUE(fails({"particles", "--shading", "flat"}, 2, "--shading", {"no effect"}));
  EXPECT_TRUE(picture_of({"mixed.json"}) != picture_of({"mixed.json", "--shading", "flat"})) << "the other object is shaded";
  EXPECT_TRUE(picture_of({"red.json"}) != picture_of({"red.json", "--shading", "none"})) << "the model has a material of the scene";
}

TEST_F(Effects, SurfaceKeysOfModelsAreRefused) {
  EXPECT_TRUE(fails({"a.obj", "--set", "model.color=#00ff00"}, 3, "a.obj: objects.model.color", {"no effect", "material"}));
  EXPECT_TRUE(fails({"model.json", "--set", "a.shading=flat"}, 3, "model.json: objects.a.shading", {"lit per pixel", "material"}));
  EXPECT_TRUE(picture_of({"model.json", "--set", "a.material=red", "--set", "a.color=#00ff00"}) != picture_of({"red.json"}));
}

TEST_F(Effects, EyeAndTargetMustDiffer) {
  EXPECT_TRUE(fails({"a.obj", "--eye", "1,0,0", "--look-at", "1,0,0"}, 3, "--look-at", {"eye", "another point"}));
  EXPECT_TRUE(fails({"mixed.json", "--set", "c.position=0,0,0"}, 3, "mixed.json: cameras.c.target", {"equals position"}));
}

TEST_F(Effects, ScenesThatDrawNothingAreReported) {
  const std::string nothing = "nothing is visible in the picture; try ";
  EXPECT_TRUE(warns({"earth", "--set", "earth.visible=false"}, nothing, {"--set objects.earth.visible=true", "hidden"}));
  EXPECT_TRUE(warns({"a.obj", "--set", "model.visible=false"}, nothing, {"--set objects.model.visible=true"}));
  write("none.json", scene(""));
  EXPECT_TRUE(warns({"none.json"}, nothing, {"objects or particles"}));
  EXPECT_TRUE(warns({"particles", "--set", "particles.count=0"}, nothing, {"objects or particles"}));
  picture_of({"none.json", "--set", "background.type=stars"});
}

TEST_F(Effects, MapsThatAreMultipliedByZeroAreReported) {
  write_png(directory / "map.png", Image<glm::u8vec4>(2, 2));
  EXPECT_TRUE(
      fails({"mixed.json", "--set", "b.emissive_map=none.png"}, 3, "mixed.json: objects.b.emissive_map", {"none.png", "no such file"}));
  EXPECT_TRUE(
      warns({"mixed.json", "--set", "b.emissive_map=map.png"}, "objects.b.emissive_map", {"no effect", "emissive is 0", "above 0"}));
  EXPECT_TRUE(warns({"mixed.json", "--set", "b.shininess_map=map.png"}, "objects.b.shininess_map", {"no effect", "specular is 0"}));
  picture_of({"mixed.json", "--set", "b.emissive_map=map.png", "--set", "b.emissive=1"});
  picture_of({"day-night", "--time", "12"});  // an animation makes the emission positive at other times
}

}  // namespace
}  // namespace halfspace
