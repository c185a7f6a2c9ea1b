// SPDX-License-Identifier: Apache-2.0
//
// `render --frames` and `--shard`: which frames are rendered, and the names of their files.
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/cli_run.h"

namespace halfspace {
namespace {

class Frames : public Cli {
 protected:
  Outcome render(std::vector<std::string> words) const {
    words.insert(words.begin(), {"render", "moon", "--size", "16x9"});
    return run(words);
  }
  // Renders and compares the names of all files.
  void expect_files(const std::vector<std::string>& words, const std::vector<std::string>& expected) {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
      if (entry.is_regular_file()) found.push_back(fs::relative(entry.path(), directory).string());
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
    fs::remove_all(directory);
    fs::create_directory(directory);
  }
  void expect_usage_error(const std::vector<std::string>& words, const std::vector<std::string>& texts) const {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    for (const std::string& text : texts) EXPECT_NE(o.err.find(text), std::string::npos) << o.err;
    EXPECT_TRUE(fs::is_empty(directory));
  }
};

TEST_F(Frames, SelectsOneFrameOrEveryNth) {
  expect_files({"--frames", "7", "-o", "m.png"}, {"m_0007.png"});
  expect_files({"--frames", "3..12:4", "-o", "m.png"}, {"m_0003.png", "m_0007.png", "m_0011.png"});
  expect_files({"--frames", "5..5:9", "-o", "m.png"}, {"m_0005.png"});
}

TEST_F(Frames, PlacesTheNumberInTheName) {
  expect_files({"--frames", "9..10", "-o", "%01d.png"}, {"10.png", "9.png"});
  expect_files({"--frames", "9..10", "-o", "a/%02d-m.png"}, {"a/09-m.png", "a/10-m.png"});
  expect_files({"--frames", "1..2", "-o", "{frame}/m.png"}, {"0001/m.png", "0002/m.png"});
  expect_files({"--frames", "100..101", "-o", "%02d/%03d.png"}, {"100/100.png", "101/101.png"});
  expect_files({"--frames", "3", "-o", "50%%_%%04d_50%.png"}, {"50%_%04d_50%_0003.png"});
  // The last frame as given determines the digits, so that a run with a step can be completed.
  expect_files({"--frames", "0..10000:9999", "-o", "m.png"}, {"m_00000.png", "m_09999.png"});
}

TEST_F(Frames, SinglePicturesKeepTheirNames) {
  for (const char* name : {"100%.png", "50%dark.png", "a%%b.png", "%%04d.png", "%4d.png"}) expect_files({"-o", name}, {name});
}

TEST_F(Frames, RefusesNamesAndRangesThatDoNotFit) {
  expect_usage_error({"-o", "m_%04d.png"}, {"'m_%04d.png'", "--frames FIRST..LAST"});
  expect_usage_error({"-o", "{frame}.png"}, {"'{frame}.png'", "--frames FIRST..LAST"});
  for (const char* name : {"%d.png", "%4d.png", "%00d.png", "%010d.png", "50%dark.png"}) {
    expect_usage_error({"--frames", "0..3", "-o", name}, {"'" + std::string(name) + "'", "%04d", "%%"});
  }
  expect_usage_error({"--frames", "0..3", "-o", "m%03d.bmp"}, {"'m%03d.bmp'", ".png"});
  for (const char* frames : {"1..", "..3", "1..3:", "1..3:0", "1..3:-1", "1..3:x", "1:3", "3..1:1", "1..2..3"}) {
    expect_usage_error({"--frames", frames, "-o", "m.png"}, {"--frames is '" + std::string(frames) + "'", "FIRST..LAST:STEP"});
  }
  for (const char* shard : {"2/2", "0/-1", "0/0", "1", "a/2", "0/2/3", "0/1000001", "/2", "0/"}) {
    expect_usage_error({"--frames", "0..3", "--shard", shard, "-o", "m.png"}, {"--shard is '" + std::string(shard) + "'", "0 to N - 1"});
  }
  expect_usage_error({"--shard", "0/2", "-o", "m.png"}, {"--shard", "--frames FIRST..LAST", "--list FILE"});
}

TEST_F(Frames, PlacesTheNameOfTheScene) {
  expect_files({"-o", "{name}-{name}.png"}, {"moon-moon.png"});
  expect_files({"--frames", "3", "-o", "{name}/{frame}.png"}, {"moon/0003.png"});
  expect_files({"--frames", "3", "-o", "{name}.png"}, {"moon_0003.png"});
}

// The maps are as detailed as the closest view of all frames requires, so a shard must not look only at its own frames.
TEST_F(Frames, ShardsGiveTheFilesOfOneRun) {
  nlohmann::json scene = nlohmann::json::parse(run({"render", "moon", "--print"}).out);
  const std::string camera = scene.at("camera");
  scene["animations"] = {{"zoom", {{"type", "rate"}, {"target", "cameras." + camera + ".fov"}, {"rate", -30}}}};
  write_bytes(directory / "zoom.json", scene.dump());
  const auto render = [&](const std::string& frames, const std::string& out, const std::string& shard) {
    const Outcome o = run({"render", "zoom.json", "--size", "64x36", "--frames", frames, "-o", out + "/m.png", "--shard", shard});
    EXPECT_EQ(o.exit_code, 0) << o.err;
  };
  render("0..30:5", "whole", "0/1");
  for (const char* shard : {"0/3", "1/3", "2/3"}) render("0..30:5", "parts", shard);
  for (int frame = 0; frame <= 30; frame += 5) {
    const std::string name = "m_00" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".png";
    EXPECT_EQ(read_bytes(directory / "whole" / name), read_bytes(directory / "parts" / name)) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(directory / "parts"), fs::directory_iterator()), 7);
  render("0", "alone", "0/1");
  EXPECT_NE(read_bytes(directory / "alone/m_0000.png"), read_bytes(directory / "whole/m_0000.png")) << "the frames have the same maps";
}

TEST_F(Frames, ShardsWithoutFramesRenderNothing) {
  const Outcome o = render({"--frames", "0..1", "--shard", "5/8", "-o", "m.png"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_TRUE(fs::is_empty(directory));
}

// The frame that would overwrite an input is found before the first frame is rendered.
TEST_F(Frames, InputsAreNotOverwritten) {
  const std::pair<const char*, const char*> names[] = {
      {"f_0003.png", "f.png"}, {"f1032.png", "f1%02d2.png"}, {"0003/m.png", "{frame}/m.png"}, {"03/003.png", "%02d/%03d.png"}};
  for (const auto& [texture, out] : names) {
    write_bytes(directory / "a.mtl", "newmtl m\nmap_Kd " + std::string(texture) + "\n");
    write_bytes(directory / "a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    fs::create_directories((directory / texture).parent_path());
    write_png(directory / texture, Image<glm::u8vec4>(2, 2));
    const Outcome o = run({"render", "a.obj", "--size", "16x9", "--frames", "1..4", "-o", out});
    EXPECT_EQ(o.exit_code, 4) << o.err;
    EXPECT_EQ(o.err, "halfspace: " + std::string(texture) + ": is read by this command; expected another output file\n");
    const auto entries = fs::recursive_directory_iterator(directory);
    EXPECT_EQ(std::count_if(begin(entries), end(entries), [](const fs::directory_entry& e) { return e.is_regular_file(); }), 3) << texture;
    fs::remove_all(directory);
    fs::create_directory(directory);
  }
}

TEST_F(Frames, ResumesPatterns) {
  const std::pair<const char*, const char*> names[] = {
      {"%03d/m.png", "000/m.png"}, {"m-%02d.png", "m-00.png"}, {"{frame}.png", "0000.png"}, {"m%02d2x.png", "m002x.png"}};
  for (const auto& [name, first] : names) {
    ASSERT_EQ(render({"--frames", "0..2", "-o", name}).exit_code, 0);
    fs::remove(directory / first);
    EXPECT_EQ(render({"--frames", "0..2", "-o", name, "--resume"}).err, "halfspace: kept 2 pictures, rendered 1: 1 missing\n") << name;
    EXPECT_TRUE(fs::exists(directory / first)) << name;
  }
}

}  // namespace
}  // namespace halfspace
