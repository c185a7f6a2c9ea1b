// SPDX-License-Identifier: Apache-2.0
//
// `render --naive`: the naive pipeline draws the picture, and the report compares it with the tile-based one.
#include <algorithm>
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class NaiveOption : public Cli {
 protected:
  // Renders with and without --naive, and compares the pictures.
  void expect_same_picture(const std::vector<std::string>& arguments, const std::string& extension) const {
    std::vector<std::string> words{"render"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--size", "96x54", "--set", "samples=1", "-o", "tiles" + extension});
    ASSERT_EQ(run(words).exit_code, 0);
    words.back() = "naive" + extension;
    words.emplace_back("--naive");
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find("naive pipeline: 0 of 5184 pixels differ"), std::string::npos) << o.out;
    const Image<glm::vec4> tiles = read_linear(directory / ("tiles" + extension)), naive = read_linear(directory / ("naive" + extension));
    EXPECT_TRUE(std::ranges::equal(tiles.texels(), naive.texels())) << arguments.front() << extension;
    EXPECT_GT(naive.texels().size(), 0u);
  }
  void expect_refusal(const std::vector<std::string>& arguments, int exit_code, const std::string& word) const {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, exit_code);
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_NE(o.err.find(word), std::string::npos) << o.err;
    EXPECT_EQ(std::ranges::count(files(), "a.png"), 0);
  }
};

TEST_F(NaiveOption, DrawsTheSamePicture) {
  expect_same_picture({"earth"}, ".png");  // stored as halves, tone curve
  expect_same_picture({"moon"}, ".png");   // encoded as sRGB only
  expect_same_picture({"day-night", "--set", "post.auto_exposure=true"}, ".png");
  expect_same_picture({"three-lights", "--bits", "16"}, ".png");
  expect_same_picture({"earth"}, ".exr");
}

TEST_F(NaiveOption, SumsAllFrames) {
  const Outcome o = run({"render", "shadow-plane", "--size", "32x18", "--naive", "--frames", "0..2", "--set", "samples=1", "-o", "a.png"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.out.find(" 0 of 1728 pixels differ; takes "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find(" times as long ("), std::string::npos) << o.out;
}

TEST_F(NaiveOption, ReportsWhatItCannotDraw) {
  const auto render = [](std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--naive", "--size", "96x54", "-o", "a.png"});
    return words;
  };
  expect_refusal(render({"particles", "--set", "samples=1"}), 3, "particles: particles: is drawn with points");
  expect_refusal(render({"moon", "--set", "samples=4"}), 3, "moon: samples: is 4");
  expect_refusal(render({"moon", "--set", "samples=1", "--wireframe"}), 3, "moon: objects.moon: is drawn with outlines");
  expect_refusal(render({"moon", "--set", "samples=1", "--set", "moon.normal_lines=1"}), 3,
                 "moon: objects.moon: is drawn with lines of normals");
  std::ofstream(directory / "glass.mtl") << "newmtl glass\nd 0.5\n";
  std::ofstream(directory / "glass.obj") << "mtllib glass.mtl\nusemtl glass\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(directory / "glass.json") << R"({"version": 1, "cameras": {"c": {"position": [0, 1, 4]}}, "lights": {"l": {}},
    "objects": {"cube": {"shape": "cube"}, "pane": {"shape": "file", "file": "glass.obj"}}})";
  expect_refusal(render({"glass.json"}), 3, "objects.pane: is drawn with blending");
  expect_refusal(render({"moon", "--crop", "0,0,8,8"}), 2, "--crop");
  expect_refusal(render({"moon", "--aov", "depth"}), 2, "--aov");
}

TEST_F(NaiveOption, ReportsToStandardErrorIfThePictureGoesToStandardOutput) {
  const Outcome o = run({"render", "moon", "--naive", "--size", "32x18", "--set", "samples=1", "-o", "/dev/stdout"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.err.find("pixels differ"), std::string::npos);
  EXPECT_EQ(o.out.substr(1, 3), "PNG");
}

}  // namespace
}  // namespace halfspace
