// SPDX-License-Identifier: Apache-2.0
//
// The files that `halfspace render` writes: --aov, --crop, --bits, transparent backgrounds, and the text in image files.
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class Outputs : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    std::ofstream(directory / "scene.json") << R"({"version": 1, "cameras": {"c": {"position": [0, 1, 4]}}, "ambient": 0.3,
      "lights": {"l": {"direction": [1, 2, 3]}}, "objects": {"cube": {"shape": "cube", "rotation": [20, 30, 0]}}})";
    std::ofstream(directory / "triangle.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  }

  Outcome render(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", "scene.json", "--size", "96x64"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  void expect_success(const std::vector<std::string>& more) const {
    const Outcome o = render(more);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
  }
  void expect_usage_error(const std::vector<std::string>& more, const std::string& word) const {
    const Outcome o = render(more);
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_EQ(lines_of(o.err), 1);
    EXPECT_NE(o.err.find(word), std::string::npos) << o.err;
  }
  std::string bytes(const std::string& name) const { return read_bytes(directory / name); }
  bool has(const std::string& name, const std::string& text) const { return bytes(name).find(text) != std::string::npos; }
};

TEST_F(Outputs, ValuesAreWrittenNextToThePicture) {
  expect_success({"--aov", "depth,normal,object,triangle,uv"});
  EXPECT_EQ(files(), (std::vector<std::string>{"scene-aov.exr", "scene.json", "scene.png", "triangle.obj"}));
  for (const char* channel : {"depth.Z", "normal.X", "normal.Y", "normal.Z", "object.id", "triangle.id", "uv.U", "uv.V"})
    EXPECT_TRUE(has("scene-aov.exr", std::string(channel) + '\0')) << channel;
  EXPECT_FALSE(has("scene-aov.exr", "albedo"));
  EXPECT_FALSE(has("scene-aov.exr", "instance"));
}

TEST_F(Outputs, ValuesShareTheFileOfAnOpenExrPicture) {
  expect_success({"--aov", "depth,barycentrics", "-o", "all.exr"});
  expect_success({"-o", "color.exr"});
  EXPECT_EQ(files(), (std::vector<std::string>{"all.exr", "color.exr", "scene.json", "triangle.obj"}));
  EXPECT_TRUE(has("all.exr", std::string("depth.Z\0", 8)));
  EXPECT_TRUE(has("all.exr", std::string("barycentrics.X\0", 15)));
  EXPECT_FALSE(has("color.exr", "depth.Z"));
}

TEST_F(Outputs, ValuesCanHaveSeparateFiles) {
  expect_success({"--aov", "depth,albedo", "--aov-separate", "-o", "a.exr"});
  expect_success({"--aov", "depth", "--aov-separate", "--frames", "3..4", "-o", "b.png", "--crop", "44,28,8,7"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a-albedo.exr", "a-depth.exr", "a.exr", "b_0003-depth.exr", "b_0003.png", "b_0004-depth.exr",
                                               "b_0004.png", "scene.json", "triangle.obj"}));
  // Reading a file with a single channel returns that channel.
  const Image<float> depth = read_gray(directory / "b_0003-depth.exr");
  EXPECT_EQ(depth.width(), 8);
  EXPECT_EQ(depth.height(), 7);
  EXPECT_GT(depth.at(4, 4), 2.0f);
  EXPECT_LT(depth.at(4, 4), 5.0f);
}

// A blended surface in front of an opaque one changes the picture but not the values.
TEST_F(Outputs, BlendedSurfacesHaveNoValues) {
  std::ofstream(directory / "m.mtl") << "newmtl solid\nKd 0.8 0.2 0.2\nnewmtl glass\nKd 0.2 0.2 0.8\nd 0.5\n";
  const std::string wall = "mtllib m.mtl\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nusemtl solid\nf 1 2 3 4\n";
  const auto depth_of = [&](const std::string& name, const std::string& obj) {
    std::ofstream(directory / (name + ".obj")) << obj;
    const Outcome o = run({"render", name + ".obj", "--size", "96x64", "--eye", "0,0,5", "--look-at", "0,0,0", "--crop", "30,20,36,24",
                           "--aov", "depth", "--aov-separate", "-o", name + ".png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return read_gray(directory / (name + "-depth.exr"));
  };
  const Image<float> alone = depth_of("alone", wall);
  EXPECT_NEAR(alone.at(0, 0), 5.0f, 1e-5f);
  EXPECT_TRUE(depth_of("both", wall + "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nusemtl glass\nf 5 6 7 8\n") == alone);
  EXPECT_FALSE(picture("both.png") == picture("alone.png"));
}

TEST_F(Outputs, ResumeRendersMissingValues) {
  expect_success({"--frames", "0..1", "-o", "a.png"});
  expect_success({"--frames", "0..1", "-o", "a.png", "--resume", "--quiet", "--aov", "depth"});
  EXPECT_TRUE(fs::exists(directory / "a_0000-aov.exr") && fs::exists(directory / "a_0001-aov.exr"));
  // The files exist but do not contain all values.
  expect_success({"--frames", "0..1", "-o", "a.png", "--resume", "--quiet", "--aov", "depth,normal"});
  EXPECT_TRUE(has("a_0001-aov.exr", std::string("normal.Z\0", 9)));
  expect_success({"--frames", "0..1", "-o", "b.exr"});
  expect_success({"--frames", "0..1", "-o", "b.exr", "--resume", "--quiet", "--aov", "object"});
  EXPECT_TRUE(has("b_0001.exr", std::string("object.id\0", 10)));
}

TEST_F(Outputs, ResumeKeepsFramesWithAllValues) {
  for (const char* separate : {"--aov-separate", "--quiet"}) {
    const auto render = [&] {
      expect_success({"--frames", "0..1", "-o", "a.exr", "--aov", "depth,normal", "--resume", "--quiet", separate});
    };
    render();
    const auto before = fs::last_write_time(directory / "a_0001.exr");
    render();
    EXPECT_EQ(fs::last_write_time(directory / "a_0001.exr"), before) << separate;
    fs::remove(directory / "a_0001.exr");
  }
}

TEST_F(Outputs, ValuesDoNotReplaceInputs) {
  fs::copy_file(directory / "scene.json", directory / "scene-aov.exr");
  const Outcome o = run({"render", "scene-aov.exr", "--size", "96x64", "--aov", "depth", "-o", "scene.png"});
  EXPECT_EQ(o.exit_code, 4) << o.err;
  EXPECT_NE(o.err.find("scene-aov.exr"), std::string::npos) << o.err;
  fs::copy_file(directory / "scene.json", directory / "a_0007-camera_normal.exr");
  EXPECT_EQ(run({"render", "a_0007-camera_normal.exr", "--size", "96x64", "--aov", "camera_normal", "--aov-separate", "--frames", "0..9",
                 "-o", "a.png"})
                .exit_code,
            4);
}

TEST_F(Outputs, TextOfPicturesIsPrintable) {
  fs::copy_file(directory / "scene.json", directory / "it's a\ttab.json");
  const Outcome o = run({"render", "it's a\ttab.json", "--size", "96x64", "-o", "a.png"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_TRUE(has("a.png", R"(halfspace render 'it'\''s a\x09tab.json')")) << bytes("a.png");
}

TEST_F(Outputs, OptionsAreChecked) {
  expect_usage_error({"--aov", "depth,normals"}, "did you mean 'normal'");
  expect_usage_error({"--aov-separate"}, "--aov LIST");
  expect_usage_error({"--aov", "depth", "-o", "/dev/stdout"}, "--aov");
  expect_usage_error({"--aov", "depth", "--wireframe"}, "--wireframe");
  expect_usage_error({"--bits", "12"}, "8 or 16");
  expect_usage_error({"--bits", "16", "-o", "a.tif"}, ".png");
  for (const char* crop : {"1,2,3", "1,2,3,4,5", "0,0,97,1", "0,0,0,1", "-1,0,4,4", "90,0,7,1", "a,b,c,d", "0,0,4294967296,1"})
    expect_usage_error({"--crop", crop}, "X,Y,W,H");
  for (const char* out : {"a.jpg", "a.hdr"}) expect_usage_error({"--set", "background.type=transparent", "-o", out}, "transparent");
  EXPECT_EQ(files().size(), 2u);
  const Outcome help = run({"render", "--help-output"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* option : {"--aov LIST", "--aov-separate", "--bits N", "--crop X,Y,W,H", "NAME.png", "NAME-render.png"})
    EXPECT_NE(help.out.find(option), std::string::npos);
}

TEST_F(Outputs, CropIsPartOfThePicture) {
  expect_success({"-o", "whole.png"});
  expect_success({"-o", "part.png", "--crop", "30,10,41,17"});
  const Image<glm::u8vec4> whole = read_image(directory / "whole.png"), part = read_image(directory / "part.png");
  ASSERT_EQ(part.width(), 41);
  ASSERT_EQ(part.height(), 17);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 41; ++x) ASSERT_EQ(part.at(x, y), whole.at(30 + x, 10 + y));
  }
}

TEST_F(Outputs, SixteenBitsAndTransparency) {
  expect_success({"--bits", "16", "--set", "background.type=transparent", "-o", "fine.png"});
  EXPECT_EQ(bytes("fine.png")[24], 16);  // bit depth in IHDR
  EXPECT_EQ(bytes("fine.png")[25], 6);   // color type: RGBA
  const Image<glm::u8vec4> picture = read_image(directory / "fine.png");
  EXPECT_EQ(picture.at(0, 0), glm::u8vec4(0));
  EXPECT_EQ(picture.at(48, 32).w, 255);
  const Outcome model = run({"render", "triangle.obj", "--size", "64x64", "--background", "transparent"});
  EXPECT_EQ(model.exit_code, 0) << model.err;
  EXPECT_EQ(read_image(directory / "triangle-render.png").at(1, 1).w, 0);
}

// The stored text contains only options that affect pixels. File names have no folders, and the number of threads is omitted.
TEST_F(Outputs, FilesRecordHowTheyWereMade) {
  fs::create_directory(directory / "folder");
  fs::copy_file(directory / "scene.json", directory / "folder/scene.json");
  for (const std::string threads : {"1", "3"}) {
    const std::vector<std::string> more{"--crop", "0,0,9,9", "--threads", threads, "--set", "ambient=0.5"};
    for (const std::string& out : {"a" + threads + ".png", "a" + threads + ".exr"}) {
      std::vector<std::string> words{"render", (directory / "folder/scene.json").string(), "--size", "96x64", "-o", out, "--time", "0.25"};
      words.insert(words.end(), more.begin(), more.end());
      EXPECT_EQ(run(words).exit_code, 0);
      EXPECT_TRUE(has(out, "halfspace render scene.json --size 96x64 --set ambient=0.5 --time 0.25 --crop 0,0,9,9"));
      EXPECT_TRUE(has(out, "Halfspace "));
      EXPECT_FALSE(has(out, "folder"));
      EXPECT_FALSE(has(out, "threads"));
    }
  }
  EXPECT_EQ(bytes("a1.png"), bytes("a3.png"));
  EXPECT_EQ(bytes("a1.exr"), bytes("a3.exr"));
}

}  // namespace
}  // namespace halfspace
