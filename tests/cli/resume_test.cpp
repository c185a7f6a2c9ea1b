// SPDX-License-Identifier: Apache-2.0
//
// `render --resume` keeps a picture only if it is the one that this run would write.
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_text.h"

namespace halfspace {
namespace {

class Resume : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_bytes(directory / "triangle.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_bytes(directory / "m.mtl", "newmtl m\nKd 0.8 0.2 0.2\n");
    write_bytes(directory / "scene.json",
                R"({"version": 1, "lights": {"l": {}}, "cameras": {"c": {"position": [0, 0, 5]}},
                    "objects": {"a": {"shape": "cube"}, "b": {"shape": "file", "file": "triangle.obj"}},
                    "animations": {"turn": {"type": "rate", "target": "a.rotation", "rate": [0, 30, 0]}}})");
  }
  Outcome render(std::vector<std::string> words, const std::string& out = "a.png") const {
    words.insert(words.begin(), {"render", "scene.json", "--size", "32x18", "--frames", "0..2", "-o", out, "--resume"});
    return run(words);
  }
  // Renders all pictures, and then again with other arguments or files. Expects a line with the reason, or that all pictures are kept.
  void expect_reason(const std::vector<std::string>& other, const std::string& reason, const std::string& out = "a.png") {
    fs::remove_all(directory / "out");
    ASSERT_EQ(render({}, "out/" + out).exit_code, 0);
    expect_line(other, reason, out);
    expect_line(other, "", out);
  }
  void expect_line(const std::vector<std::string>& other, const std::string& reason, const std::string& out = "a.png") {
    const Outcome o = render(other, "out/" + out);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err,
              reason.empty() ? "halfspace: kept 3 pictures, rendered 0\n" : "halfspace: kept 0 pictures, rendered 3: 3 " + reason + "\n");
  }
  // Returns the formats that this build can write.
  static std::vector<std::string> formats() {
    if (run_info().find("not found: only PNG") != std::string::npos) return {"a.png", "a.jpg", "a.exr"};
    return {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"};
  }
  static std::string run_info() {
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "info").string();
    return std::system((HALFSPACE_PROGRAM " info > " + out).c_str()) == 0 ? read_bytes(out) : "";
  }
};

TEST_F(Resume, KeepsThePicturesOfTheSameCommand) {
  for (const std::string& format : formats()) {
    expect_reason({}, "", format);
    expect_reason({"--threads", "1"}, "", format);
  }
}

TEST_F(Resume, RendersPicturesOfOtherSettingsAgain) {
  const std::string reason = "of another scene, time or setting";
  for (const std::string& format : formats()) expect_reason({"--set", "ambient=0.5"}, reason, format);
  for (const std::vector<std::string>& other : std::vector<std::vector<std::string>>{{"--time", "1"},
                                                                                     {"--set", "cameras.c.fov=30"},
                                                                                     {"--crop", "8,4,16,9"},
                                                                                     {"--shading", "flat"},
                                                                                     {"--bits", "16"},
                                                                                     {"--max-error", "1"}})
    expect_reason(other, reason);
  fs::remove_all(directory / "out");
  ASSERT_EQ(render({}, "out/a.png").exit_code, 0);
  EXPECT_EQ(render({"--fps", "12"}, "out/a.png").err, "halfspace: kept 1 picture, rendered 2: 2 " + reason + "\n")
      << "the time of frame 0 is the same";
}

TEST_F(Resume, RendersPicturesOfOtherSizesAgain) {
  ASSERT_EQ(render({}).exit_code, 0);
  const Outcome o = run({"render", "scene.json", "--size", "48x27", "--frames", "0..2", "-o", "a.png", "--resume"});
  EXPECT_EQ(o.err, "halfspace: kept 0 pictures, rendered 3: 3 of another scene, time or setting\n");
  EXPECT_EQ(picture("a_0002.png").width(), 48);
}

// The other pictures of a run are not part of a fingerprint.
TEST_F(Resume, KeepsPicturesOfOtherRangesAndShards) {
  ASSERT_EQ(render({"--shard", "1/3"}).exit_code, 0);
  EXPECT_EQ(render({}).err, "halfspace: kept 1 picture, rendered 2: 2 missing\n");
  EXPECT_EQ(run({"render", "scene.json", "--size", "32x18", "--frames", "1..3", "-o", "a.png", "--resume"}).err,
            "halfspace: kept 2 pictures, rendered 1: 1 missing\n");
}

TEST_F(Resume, SeesTheContentOfAllInputFiles) {
  expect_reason({}, "");
  write_bytes(directory / "triangle.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  expect_line({}, "of other input files");
  expect_line({}, "");
  const auto time = fs::last_write_time(directory / "m.mtl");
  write_bytes(directory / "m.mtl", "newmtl m\nKd 0.8 0.2 0.3\n");  // of the same length
  fs::last_write_time(directory / "m.mtl", time);
  expect_line({}, "of other input files");
  fs::last_write_time(directory / "m.mtl", fs::file_time_type::clock::now());
  expect_line({}, "");
}

TEST_F(Resume, RendersOtherFilesAgain) {
  ASSERT_EQ(render({}).exit_code, 0);
  // A picture of another program, another picture of the same run, the end of a file missing, and no picture at all.
  write_image(directory / "a_0000.png", Image<glm::u8vec4>(32, 18));
  fs::copy_file(directory / "a_0002.png", directory / "a_0001.png", fs::copy_options::overwrite_existing);
  write_bytes(directory / "a_0002.png", "hello");
  EXPECT_EQ(render({}).err,
            "halfspace: kept 0 pictures, rendered 3: 1 incomplete, 1 without a fingerprint, 1 of another scene, time or setting\n");
  EXPECT_EQ(render({}).err, "halfspace: kept 3 pictures, rendered 0\n");
}

TEST_F(Resume, RendersPicturesOfOtherBuildsAgain) {
  ASSERT_EQ(render({}).exit_code, 0);
  const ImageText text = read_image_text(directory / "a_0001.png");
  ASSERT_TRUE(text.fingerprint.starts_with("build ")) << text.fingerprint;
  ImageText other = text;
  other.fingerprint.replace(6, text.fingerprint.find(" scene") - 6, "0123456789ab");
  write_image(directory / "a_0001.png", picture("a_0001.png"), other);
  EXPECT_EQ(render({}).err, "halfspace: kept 2 pictures, rendered 1: 1 of another build\n");
  EXPECT_EQ(read_image_text(directory / "a_0001.png").fingerprint, text.fingerprint);
}

// A file with the right fingerprint but without its values is not complete.
TEST_F(Resume, ComparesTheFilesOfAllValues) {
  for (const char* separate : {"--aov-separate", "--resume"}) {
    ASSERT_EQ(render({"--aov", "depth,normal", separate}).exit_code, 0);
    EXPECT_EQ(render({"--aov", "depth,normal", separate}).err, "halfspace: kept 3 pictures, rendered 0\n");
    fs::remove(directory / (separate == std::string("--resume") ? "a_0001-aov.exr" : "a_0001-normal.exr"));
    EXPECT_EQ(render({"--aov", "depth,normal", separate}).err, "halfspace: kept 2 pictures, rendered 1: 1 missing\n");
    EXPECT_EQ(render({"--aov", "depth", separate}).err, "halfspace: kept 0 pictures, rendered 3: 3 of another scene, time or setting\n");
  }
}

TEST_F(Resume, IsSilentIfQuiet) { EXPECT_EQ(render({"--quiet"}).err, ""); }

}  // namespace
}  // namespace halfspace
