// SPDX-License-Identifier: Apache-2.0
//
// Wireframes of models and scenes.
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class Wireframe : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  // Renders a scene with a black background and these objects, and returns the picture.
  Image<glm::u8vec4> picture(const std::string& objects, const std::string& option, const std::string& head = "") const {
    write("scene.json", R"({"version": 1, )" + head + R"("cameras": {"c": {"position": [1, 2, 4]}}, "lights": {"sun": {}}, "objects": {)" +
                            objects + "}}");
    const Outcome o = run({"render", "scene.json", "--size", "160x120", "-o", "a.png", option});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    warnings = o.err;
    return read_image(directory / "a.png");
  }
  static int pixels_that_are(const Image<glm::u8vec4>& image, const glm::u8vec4& color) {
    return static_cast<int>(std::ranges::count(image.texels(), color));
  }
  mutable std::string warnings;
};

constexpr glm::u8vec4 kWhite(255), kBlack(0, 0, 0, 255);

TEST_F(Wireframe, HiddenLinesAreShownOrRemoved) {
  const Image<glm::u8vec4> all = picture(R"("cube": {"shape": "cube"})", "--wireframe");
  const Image<glm::u8vec4> visible = picture(R"("cube": {"shape": "cube"})", "--wireframe=hidden");
  const int all_white = pixels_that_are(all, kWhite), visible_white = pixels_that_are(visible, kWhite);
  EXPECT_EQ(pixels_that_are(all, kBlack) + all_white, 160 * 120);
  EXPECT_EQ(pixels_that_are(visible, kBlack) + visible_white, 160 * 120);
  // The cube has 18 edges, of which 12 are visible, at most 60 pixels long.
  EXPECT_GT(visible_white, 250);
  EXPECT_GT(all_white, visible_white + 80);
  EXPECT_LT(all_white, 1100);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      EXPECT_TRUE(visible.at(x, y) != kWhite || all.at(x, y) == kWhite) << x << " " << y;
    }
  }
}

TEST_F(Wireframe, DoesNotDependOnTheShader) {
  const auto cube = [](const std::string& surface) { return R"("cube": {"shape": "cube", )" + surface + "}"; };
  const Image<glm::u8vec4> expected = picture(cube(R"("shading": "none")"), "--wireframe");
  for (const char* surface : {R"("shading": "flat")", R"("shading": "provoking")", R"("shading": "gouraud")", R"("shading": "phong")",
                              R"("color": "missing.png", "textured": false)", R"("emissive": 1, "two_sided": true)"}) {
    const Image<glm::u8vec4> image = picture(cube(surface), "--wireframe");
    EXPECT_TRUE(std::ranges::equal(image.texels(), expected.texels())) << surface;
  }
}

TEST_F(Wireframe, LinesOfNormalsAreUnchanged) {
  const Image<glm::u8vec4> image = picture(R"("cube": {"shape": "cube", "normal_lines": 1})", "--wireframe");
  EXPECT_GT(pixels_that_are(image, glm::u8vec4(188, 255, 188, 255)), 20) << "sRGB of (0.5, 1, 0.5), the normal of the upper side";
}

TEST_F(Wireframe, LinesContrastWithTheBackground) {
  const Image<glm::u8vec4> image = picture(R"("cube": {"shape": "cube"})", "--wireframe", R"("background": {"color": 1}, "samples": 1, )");
  EXPECT_GT(pixels_that_are(image, kBlack), 250);
  EXPECT_EQ(pixels_that_are(image, kBlack) + pixels_that_are(image, kWhite), 160 * 120);
}

TEST_F(Wireframe, SpheresWithoutMeshAreReported) {
  picture(R"("ball": {"shape": "sphere"})", "--wireframe");
  EXPECT_EQ(lines_of(warnings), 1);
  EXPECT_NE(warnings.find("spheres"), std::string::npos);
  picture(R"("ball": {"shape": "icosphere"})", "--wireframe");
  EXPECT_EQ(warnings, "");
}

TEST_F(Wireframe, ModelsAreDrawnWithoutTheirFloor) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome o = run({"render", "a.obj", "--size", "160x120", "--wireframe", "--stats"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.out.find("primitives_in        1\n"), std::string::npos) << o.out;
}

TEST_F(Wireframe, RejectsOtherValues) { EXPECT_EQ(run({"render", "earth", "--wireframe=all"}).exit_code, 2); }

}  // namespace
}  // namespace halfspace
