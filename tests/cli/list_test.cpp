// SPDX-License-Identifier: Apache-2.0
//
// `render` with several scenes: --list, {name}, --report.
#include <nlohmann/json.hpp>

#include "cli/cli_run.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

class Lists : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    for (const char* name : {"a", "b", "c"}) {
      const std::string depth = std::to_string(1 + name[0] - 'a');
      write_bytes(directory / (name + std::string(".obj")), "v 0 0 0\nv " + depth + " 0 0\nv 0 1 " + depth + "\nf 1 2 3\n");
    }
    write_bytes(directory / "broken.obj", "v 0 0 0\nf 1 2 3\n");
  }
  Outcome render(std::vector<std::string> words) const {
    words.insert(words.begin(), {"render", "--size", "32x18"});
    return run(words);
  }
  nlohmann::json report() const { return nlohmann::json::parse(read_bytes(directory / "report.json")); }
};

TEST_F(Lists, GiveThePicturesOfSingleRuns) {
  write_bytes(directory / "list.txt", "b.obj\n\nc.obj\r\nmoon\n");
  const Outcome o = render({"a.obj", "--list", "list.txt", "-o", "out/{name}.png"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  for (const char* name : {"a", "b", "c", "moon"}) {
    const std::string scene = name == std::string("moon") ? name : name + std::string(".obj");
    EXPECT_EQ(render({scene, "-o", "one.png"}).exit_code, 0);
    EXPECT_TRUE(picture("out/" + std::string(name) + ".png") == picture("one.png")) << name;
  }
}

TEST_F(Lists, ReadStandardInput) {
  const Outcome o = run_in("printf 'a.obj\\nb.obj\\n' |", "render --list - --size 32x18");
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_TRUE(fs::exists(directory / "a-render.png") && fs::exists(directory / "b-render.png"));
  const Outcome empty = run_in("printf '\\n' |", "render --list - --size 32x18");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_NE(empty.err.find("standard input has no scenes"), std::string::npos) << empty.err;
}

// A scene that fails costs one line and its own picture.
TEST_F(Lists, ContinueAfterFailures) {
  const Outcome o = render({"a.obj", "broken.obj", "missing.obj", "b.obj", "no-scene", "-o", "{name}.png", "--report", "report.json"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_EQ(lines_of(o.err), 4) << o.err;
  for (const char* text : {"halfspace: broken.obj", "halfspace: missing.obj", "halfspace: no-scene", "3 of 5 scenes failed"})
    EXPECT_NE(o.err.find(text), std::string::npos) << text << o.err;
  EXPECT_TRUE(fs::exists(directory / "a.png") && fs::exists(directory / "b.png"));
  EXPECT_FALSE(fs::exists(directory / "broken.png"));
  EXPECT_EQ(report().at("failed"), 3);
  ASSERT_EQ(report().at("scenes").size(), 5u);
  EXPECT_EQ(report().at("scenes")[0].at("scene"), "a.obj");
  EXPECT_EQ(report().at("scenes")[0].at("rendered"), 1);
  EXPECT_FALSE(report().at("scenes")[0].contains("problem"));
  EXPECT_EQ(report().at("scenes")[2].at("rendered"), 0);
  EXPECT_NE(report().at("scenes")[2].at("problem").get<std::string>().find("missing.obj"), std::string::npos);
}

// An output that cannot be written, or that is an input, belongs to its own scene.
TEST_F(Lists, ContinueAfterOutputErrors) {
  fs::create_directory(directory / "a.png");
  const Outcome o = render({"a.obj", "b.obj", "-o", "{name}.png"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("a.png: is a directory"), std::string::npos) << o.err;
  EXPECT_TRUE(fs::exists(directory / "b.png"));
}

TEST_F(Lists, CombineWithFramesAndShards) {
  const std::vector<std::string> words{"a.obj", "b.obj", "c.obj", "--turntable", "2", "-o", "{name}-%02d.png"};
  for (const char* shard : {"0/2", "1/2"}) {
    std::vector<std::string> part = words;
    part.insert(part.end(), {"--shard", shard, "--report", "report.json"});
    EXPECT_EQ(render(part).exit_code, 0);
    EXPECT_EQ(report().at("scenes").size(), shard[0] == '0' ? 2u : 1u);
  }
  const std::vector<std::string> expected{"a-00.png",   "a-01.png", "a.obj",    "b-00.png", "b-01.png",   "b.obj",
                                          "broken.obj", "c-00.png", "c-01.png", "c.obj",    "report.json"};
  EXPECT_EQ(files(), expected);
  std::vector<std::string> again = words;
  again.push_back("--resume");
  EXPECT_EQ(render(again).err, "halfspace: kept 6 pictures, rendered 0\n");
}

// Pictures must not depend on the scenes before them, also not by maps that are as fine as the closest view needs.
TEST_F(Lists, DoNotShareTheDetailOfMaps) {
  for (const char* fov : {"5", "60"}) {
    nlohmann::json scene = nlohmann::json::parse(run({"render", "moon", "--print"}).out);
    scene["cameras"][scene.at("camera").get<std::string>()]["fov"] = std::atoi(fov);
    write_bytes(directory / (std::string("moon") + fov + ".json"), scene.dump());
  }
  ASSERT_EQ(render({"moon5.json", "moon60.json", "--frames", "0", "-o", "{name}.png"}).exit_code, 0);
  ASSERT_EQ(render({"moon60.json", "--frames", "0", "-o", "alone.png"}).exit_code, 0);
  EXPECT_TRUE(picture("moon60_0000.png") == picture("alone_0000.png"));
}

TEST_F(Lists, ResumeKeepsPictures) {
  ASSERT_EQ(render({"a.obj", "b.obj", "c.obj", "-o", "{name}.png"}).exit_code, 0);
  write_bytes(directory / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 3 3\nf 1 2 3\n");
  fs::remove(directory / "c.png");
  const Outcome o = render({"a.obj", "b.obj", "c.obj", "-o", "{name}.png", "--resume"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_TRUE(o.err.starts_with("halfspace: kept 1 picture, rendered 2: 1 missing, 1 of another scene")) << o.err;
}

// Memory of a scene is free for the next one, whether it was rendered or kept. One scene needs about 66 MB, and each further one that
// stayed in memory 15 MB.
TEST_F(Lists, AScenesMemoryIsFreedForTheNext) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need more memory than the limit";
  std::string grid;
  constexpr int kEdge = 300;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) grid += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
  }
  for (int y = 0; y + 1 < kEdge; ++y) {
    for (int x = 1; x < kEdge; ++x) {
      const int i = y * kEdge + x;
      grid += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + kEdge) + "\n";
    }
  }
  std::vector<std::string> words;
  for (int i = 0; i < 8; ++i) {
    const std::string name = "grid" + std::to_string(i) + ".obj";
    write_bytes(directory / name, grid);
    words.push_back(name);
  }
  words.insert(words.end(), {"-o", "{name}.png", "--max-memory", "140M", "--resume"});
  const Outcome first = render(words);
  EXPECT_EQ(first.err, "halfspace: kept 0 pictures, rendered 8: 8 missing\n");
  EXPECT_EQ(render(words).err, "halfspace: kept 8 pictures, rendered 0\n");
}

TEST_F(Lists, AnOutputIsNotAnInput) {
  write_image(directory / "c.png", Image<glm::u8vec4>(4, 4));
  write_bytes(directory / "m.mtl", "newmtl m\nmap_Kd c.png\n");
  write_bytes(directory / "a.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome o = render({"a.obj", "c.obj", "-o", "{name}.png"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("halfspace: a.obj: reads "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("c.png, which this command writes"), std::string::npos) << o.err;
  EXPECT_EQ(render({"b.obj", "c.obj", "-o", "{name}.png", "--report", "b.obj"}).exit_code, 4);
  EXPECT_EQ(render({"b.obj", "c.obj", "-o", "{name}.png", "--report", "b.png"}).exit_code, 2);
}

// A picture of a list does not replace a file of another program, because a later scene may read it.
TEST_F(Lists, TexturesOfLaterScenesAreNotReplaced) {
  write_image(directory / "c.png", Image<glm::u8vec4>(4, 4));
  write_bytes(directory / "m.mtl", "newmtl m\nmap_Kd c.png\n");
  write_bytes(directory / "a.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string texture = read_bytes(directory / "c.png");
  const Outcome o = render({"c.obj", "a.obj", "b.obj", "-o", "{name}.png"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("c.png: exists, and Halfspace did not write it"), std::string::npos) << o.err;
  EXPECT_EQ(read_bytes(directory / "c.png"), texture);
  EXPECT_TRUE(fs::exists(directory / "b.png"));
}

TEST_F(Lists, PicturesOfAnEarlierRunAreReplaced) {
  for (const char* out : {"{name}.png", "{name}.jpg", "{name}.tif", "{name}.exr", "{name}.hdr", "{name}-{frame}.png"}) {
    for (const char* size : {"8x8", "16x8"}) {
      std::vector<std::string> words = {"render", "a.obj", "b.obj", "--size", size, "--aov", "depth", "-o", out};
      if (std::string(out).find("{frame}") != std::string::npos) words.insert(words.end(), {"--frames", "0..1"});
      const Outcome o = run(words);
      EXPECT_EQ(o.exit_code, 0) << out << " " << size << " " << o.err;
    }
  }
  EXPECT_EQ(picture("b.png").width(), 16);
}

TEST_F(Lists, FailedScenesReportTheirPictures) {
  fs::create_directories(directory / "a-0002.png");
  const Outcome o =
      render({"a.obj", "b.obj", "--turntable", "4", "-o", "{name}-%04d.png", "--report", "report.json", "--progress", "json"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_EQ(report().at("scenes")[0].at("rendered"), 2);
  EXPECT_EQ(report().at("scenes")[1].at("rendered"), 4);
  EXPECT_NE(o.err.find("\"done\": 8, \"total\": 8"), std::string::npos) << o.err;
}

TEST_F(Lists, StatisticsDoNotMixWithAStream) {
  const Outcome o = render({"a.obj", "b.obj", "-o", "-", "--format", "rgb24", "--stats"});
  EXPECT_EQ(o.out.size(), 2u * 3u * 32u * 18u);
  EXPECT_NE(o.err.find("2 scenes, 32x18"), std::string::npos) << o.err;
}

TEST_F(Lists, PrintProgress) {
  const Outcome lines = render({"a.obj", "b.obj", "-o", "{name}.png", "--verbose"});
  EXPECT_EQ(lines_of(lines.err), 2) << lines.err;
  EXPECT_TRUE(lines.err.starts_with("1/2  a.png  ")) << lines.err;
  const Outcome json = render({"a.obj", "b.obj", "-o", "{name}.png", "--progress", "json", "--resume"});
  EXPECT_EQ(lines_of(json.err), 3) << json.err;
  const nlohmann::json line = nlohmann::json::parse(json.err.substr(0, json.err.find('\n')));
  EXPECT_EQ(line.at("done"), 1);
  EXPECT_EQ(line.at("total"), 2);
  EXPECT_EQ(line.at("file"), "a.png");
  EXPECT_EQ(line.at("kept"), true);
}

}  // namespace
}  // namespace halfspace
