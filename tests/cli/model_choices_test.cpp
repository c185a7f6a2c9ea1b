// SPDX-License-Identifier: Apache-2.0
//
// Names, animations, permissions and output files of models that are rendered by the program.
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"
#include "model/gltf_builder.h"

namespace halfspace {
namespace {

constexpr const char* kTriangle = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

class ModelChoices : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  void write(const std::string& name, const GltfBuilder& file) const { write(name, file.text()); }

  // Writes an OBJ file with a texture.
  void write_textured(const std::string& name, const std::string& texture) const {
    write(name + ".mtl", "newmtl m\nmap_Kd " + texture + "\n");
    write(name + ".obj", "mtllib " + name + ".mtl\nusemtl m\n" + kTriangle + "f 1/1 2/2 3/3\n");
    write_png(directory / texture, Image<glm::u8vec4>(2, 2));
  }
  void write_scene(const std::string& name, const std::string& model) const {
    write(name, R"({"version": 1, "cameras": {"main": {"position": [0, 0, 5]}}, "lights": {"sun": {"direction": [0, 0, 1]}},
      "objects": {"a": {"shape": "file", "file": ")" +
                    model + R"("}}})");
  }
  Outcome render(std::vector<std::string> words) const {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--size", "32x32"});
    return run(words);
  }
  // Runs a command that must fail because it would overwrite `file`.
  void expect_protected(const std::string& file, const std::vector<std::string>& words) const {
    const std::string before = read_bytes(directory / file);
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 4) << words[0] << ": " << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_TRUE(read_bytes(directory / file) == before) << words[0] << " overwrote " << file;
  }
  int number_of_pixels(const std::string& name, int border) const {
    const Image<glm::u8vec4> image = picture(name);
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const bool at_border = std::min({x, y, image.width() - 1 - x, image.height() - 1 - y}) < border;
        count += (border == 0 || at_border) && image.at(x, y).w != 0 ? 1 : 0;
      }
    }
    return count;
  }

  // A triangle that moves from x = 0 at time 0 to x = 10 at time 1 in each of the animations.
  static GltfBuilder moving(const std::vector<std::string>& animations) {
    GltfBuilder file;
    file.mesh_node({{"attributes", {{"POSITION", file.triangle()}}}});
    for (const std::string& name : animations) {
      GltfJson json = {
          {"samplers", {{{"input", file.accessor<float>({0, 1}, 1)}, {"output", file.accessor<float>({0, 0, 0, 10, 0, 0}, 3)}}}},
          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
      if (!name.empty()) json["name"] = name;
      file.add("animations", json);
    }
    return file;
  }
};

TEST_F(ModelChoices, CamerasAndLightsMayHaveAnyName) {
  GltfBuilder file;
  file.mesh_node({{"attributes", {{"POSITION", file.triangle()}}}});
  for (const char* name : {"My Cam", "my_cam", "MY CAM",
                           "\xc3\x9c"
                           "ber",
                           "view", ""}) {
    const int camera = file.add("cameras", {{"name", name}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    file.add("nodes", {{"name", std::string("Node of ") + name}, {"camera", camera}, {"translation", {0.3 * camera, 0, 3}}});
  }
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  for (const char* name : {"Point Light.001", "point_light_001"})
    file.json["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"name", name}, {"type", "point"}, {"intensity", 40}});
  for (int light = 0; light < 2; ++light)
    file.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}, {"translation", {0, 0, 2}}});
  write("a.gltf", file);
  const Outcome printed = render({"a.gltf", "--print"});
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  const auto scene = nlohmann::json::parse(printed.out);
  for (const char* name : {"view", "my_cam", "my_cam_1", "my_cam_2", "camera___ber", "view_1", "camera_1"})
    EXPECT_TRUE(scene.at("cameras").contains(name)) << name << printed.out;
  EXPECT_TRUE(scene.at("lights").contains("point_light_001"));
  EXPECT_TRUE(scene.at("lights").contains("point_light_001_1"));
  // A camera can be selected by its name in the file, the name of its node, and the name in the scene.
  EXPECT_EQ(render({"a.gltf", "--camera", "Node of MY CAM", "-o", "node.png"}).err, "");
  EXPECT_EQ(render({"a.gltf", "--camera", "MY CAM", "-o", "file.png"}).err, "");
  EXPECT_EQ(render({"a.gltf", "--camera", "my_cam_2", "-o", "scene.png"}).err, "");
  EXPECT_EQ(render({"a.gltf", "--camera", "My Cam", "-o", "other.png"}).err, "");
  EXPECT_TRUE(picture("file.png") == picture("scene.png"));
  EXPECT_TRUE(picture("file.png") == picture("node.png"));
  EXPECT_FALSE(picture("file.png") == picture("other.png"));
}

TEST_F(ModelChoices, NoCommandOverwritesAFileThatItReads) {
  write_textured("a", "t.png");
  write_scene("s.json", "a.obj");
  write_textured("b", "s-sun-map.png");
  write_scene("b.json", "b.obj");
  for (const char* link : {"frame_0001.png", "aov-depth.exr", "turn_0002.png"}) fs::create_symlink("t.png", directory / link);
  expect_protected("t.png", {"render", "a.obj", "--size", "32x32", "--frames", "0..2", "-o", "frame.png"});
  EXPECT_FALSE(fs::exists(directory / "frame_0000.png"));  // nothing is rendered before the error
  expect_protected("t.png", {"render", "a.obj", "--size", "32x32", "--turntable", "3", "-o", "turn.png"});
  expect_protected("t.png", {"render", "s.json", "--size", "32x32", "--aov", "depth", "--aov-separate", "-o", "aov.png"});
  fs::create_symlink("t.png", directory / "page.html");
  expect_protected("t.png", {"explain", "s.json", "--size", "32x32", "-o", "page.html"});
  expect_protected("t.png", {"convert-normal", "t.png", "-o", "t.png"});
  expect_protected("t.png", {"compare", "t.png", "t.png", "-o", "t.png"});
  fs::rename(directory / "b.json", directory / "s.json");
  if (run({"validate", "--help"}).exit_code == 0)  // a build with ray casting
    expect_protected("s-sun-map.png", {"validate", "s.json", "--size", "32x32", "-o", "."});
}

TEST_F(ModelChoices, AnimationsCanBeSelectedByIndex) {
  write("a.gltf", moving({"", ""}));
  write("named.gltf", moving({"walk", "run"}));
  write("none.gltf", moving({}));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"a.gltf", "--animation", "1"}, {"named.gltf", "--animation", "1"}, {"named.gltf", "--animation", "run"}}) {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
  }
  const std::pair<std::vector<std::string>, std::string> mistakes[] = {
      {{"a.gltf", "--animation", "2"}, "expected an index from 0 to 1"},
      {{"named.gltf", "--animation", "jump"}, "expected one of walk, run"},
      {{"none.gltf", "--animation", "0"}, "halfspace: --animation: none.gltf has no animations; expected no value, got '0'"},
      {{"none.gltf", "--variant", "0"}, "halfspace: --variant: none.gltf has no variants"},
      {{"none.gltf", "--scene", "1"}, "halfspace: --scene: none.gltf has no '1'; expected an index from 0 to 0"},
  };
  for (const auto& [words, keyword] : mistakes) {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 3) << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_NE(o.err.find(keyword), std::string::npos) << o.err;
  }
}

TEST_F(ModelChoices, ErrorsInTheViewNameTheOption) {
  write("a.gltf", moving({}));
  const std::pair<std::vector<std::string>, std::string> mistakes[] = {
      {{"--environment", "none.hdr"}, "halfspace: --environment: "},
      {{"--eye", "0,5,0", "--look-at", "0,0,0"}, "halfspace: --up: 0,1,0 is parallel"},
      {{"--up", "0,0,0"}, "halfspace: --up: is zero"},
      {{"--eye", "1e9,0,0"}, "halfspace: --eye: is too far from the model"},
  };
  for (auto [words, start] : mistakes) {
    words.insert(words.begin(), "a.gltf");
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 3) << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_TRUE(o.err.starts_with(start)) << o.err;
  }
  EXPECT_EQ(render({"a.gltf", "--eye", "0,5,0", "--look-at", "0,0,0", "--up", "0,0,-1"}).exit_code, 0);
  const Outcome explained = run({"explain", "a.gltf", "--environment", "none.hdr", "--size", "32x32", "-o", "a.html"});
  EXPECT_TRUE(explained.err.starts_with("halfspace: --environment: ")) << explained.err;
}

// Object 0 is the model; its node is at x = 10 at time 1.
TEST_F(ModelChoices, TimePlaysTheOnlyAnimation) {
  write("a.gltf", moving({""}));
  write("b.gltf", moving({"walk", "run"}));
  const auto plays = [&](const std::vector<std::string>& words) {
    const Outcome o = render(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return !nlohmann::json::parse(o.out).at("objects").at("model").value("model_animation", "").empty();
  };
  EXPECT_FALSE(plays({"a.gltf", "--print"}));
  EXPECT_TRUE(plays({"a.gltf", "--print", "--time", "1"}));
  EXPECT_TRUE(plays({"a.gltf", "--print", "--frames", "0..3"}));
  EXPECT_FALSE(plays({"a.gltf", "--print", "--turntable", "4"}));
  EXPECT_EQ(render({"a.gltf", "--time", "1"}).err, "");
  const Outcome several = render({"b.gltf", "--time", "1"});
  EXPECT_EQ(lines_of(several.err), 1);
  EXPECT_NE(several.err.find("'walk' plays, the first of 2; use --animation to select another: run"), std::string::npos) << several.err;
}

// The triangle moves by ten times its size.
TEST_F(ModelChoices, TheCameraFitsTheAnimation) {
  write("a.gltf", moving({"walk"}));
  const std::vector<std::string> look{"a.gltf",      "--animation", "walk", "--no-floor", "--background",
                                      "transparent", "--yaw",       "0",    "--pitch",    "0"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), look.begin(), look.end());
    EXPECT_EQ(render(words).exit_code, 0);
  };
  with({"-o", "still.png"});
  with({"-o", "later.png", "--time", "1"});
  const int still = number_of_pixels("still.png", 0);
  EXPECT_GT(still, 100);
  EXPECT_EQ(number_of_pixels("later.png", 0), still);  // only the position differs
  with({"-o", "f.png", "--frames", "0..2", "--fps", "2"});
  for (const char* frame : {"f_0000.png", "f_0001.png", "f_0002.png"}) {
    EXPECT_GT(number_of_pixels(frame, 0), 0) << frame;
    EXPECT_EQ(number_of_pixels(frame, 1), 0) << frame;  // does not touch the border
  }
}

// A gradient is blended, and a mask with few intermediate values stays a mask.
TEST_F(ModelChoices, SoftOpacityMapsAreBlended) {
  Image<glm::u8vec4> gradient(16, 16), mask(16, 16);
  for (int i = 0; i < 256; ++i) {
    gradient.at(i % 16, i / 16) = glm::u8vec4(glm::u8vec3(static_cast<uint8_t>(i % 16 * 17)), 255);
    mask.at(i % 16, i / 16) = glm::u8vec4(glm::u8vec3(i % 16 < 8 ? 0 : 255), 255);
  }
  mask.at(8, 3) = {128, 128, 128, 255};
  write_png(directory / "gradient.png", gradient);
  write_png(directory / "mask.png", mask);
  write("a.obj", "mtllib a.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
  const auto levels = [&](const char* map) {  // the number of different opacities in the middle row
    write("a.mtl", std::string("newmtl m\nKd 0 0 1\nmap_d -clamp on ") + map + "\n");
    const Outcome o = render({"a.obj", "--no-floor", "--background", "transparent", "--set", "samples=1", "--yaw", "0", "--pitch", "0"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    std::set<int> found;
    const Image<glm::u8vec4> image = picture("a-render.png");
    for (int x = 0; x < 32; ++x) found.insert(image.at(x, 16).w);
    return found.size();
  };
  EXPECT_GE(levels("gradient.png"), 10u);
  EXPECT_EQ(levels("mask.png"), 2u);
  EXPECT_EQ(run({"export", "a.obj", "-o", "mask.gltf"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(directory / "mask.gltf")).at("materials").at(0).at("alphaMode"), "MASK");
  levels("gradient.png");
  EXPECT_EQ(run({"export", "a.obj", "-o", "soft.gltf"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(directory / "soft.gltf")).at("materials").at(0).at("alphaMode"), "BLEND");
}

TEST_F(ModelChoices, EveryCommandCanAllowOutsideFiles) {
  fs::create_directory(directory / "in");
  write("m.mtl", "newmtl m\nKd 1 0 0\nmap_Kd ../t1.png\nmap_Ks ../t2.png\n");
  write("in/n.mtl", read_bytes(directory / "m.mtl"));
  write("in/a.obj", std::string("mtllib ../m.mtl\nusemtl m\n") + kTriangle + "f 1/1 2/2 3/3\n");
  write("in/textures.obj", std::string("mtllib n.mtl\nusemtl m\n") + kTriangle + "f 1/1 2/2 3/3\n");
  for (const char* name : {"t1.png", "t2.png"}) write_png(directory / name, Image<glm::u8vec4>(2, 2));
  write_scene("s.json", "in/a.obj");
  const Outcome rejected = render({"s.json"});
  EXPECT_EQ(rejected.exit_code, 0);
  EXPECT_NE(rejected.err.find("--allow-outside"), std::string::npos);
  const Outcome allowed = render({"s.json", "--allow-outside", "-o", "allowed.png"});
  EXPECT_EQ(allowed.exit_code, 0);
  EXPECT_EQ(allowed.err, "");
  EXPECT_FALSE(picture("s.png") == picture("allowed.png"));
  write("printed.json", render({"in/a.obj", "--allow-outside", "--print"}).out);
  EXPECT_EQ(render({"printed.json"}).err, "");
  EXPECT_NE(run({"info", "in/a.obj"}).out.find("warning:"), std::string::npos);
  EXPECT_EQ(run({"info", "in/a.obj", "--allow-outside"}).out.find("warning:"), std::string::npos);
  EXPECT_EQ(run({"export", "s.json", "--allow-outside", "-o", "s.glb"}).err, "");
  EXPECT_EQ(run({"explain", "s.json", "--allow-outside", "--size", "32x32", "--text"}).err, "");
  if (run({"validate", "--help"}).exit_code == 0) {  // a build with ray casting
    EXPECT_EQ(run({"validate", "s.json", "--allow-outside", "--size", "32x32", "--rays", "1"}).exit_code, 0);
  }
  // One warning for all textures.
  const Outcome textures = render({"in/textures.obj", "-o", "textures.png"});
  EXPECT_EQ(lines_of(textures.err), 1) << textures.err;
  EXPECT_NE(textures.err.find("and 1 more file are outside"), std::string::npos) << textures.err;
}

TEST_F(ModelChoices, MaxErrorSimplifiesFiles) {
  write_textured("a", "t.png");
  const Outcome o = render({"a.obj", "--max-error", "0.5", "--stats"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.out.find("objects.model.model_error=0.5  ("), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("objects.model: draws 1 of 1 triangles"), std::string::npos) << o.out;
  const Outcome printed = render({"a.obj", "--max-error", "0.5", "--print"});
  EXPECT_EQ(nlohmann::json::parse(printed.out).at("objects").at("model").at("model_error"), 0.5);
  const Outcome colors = render({"a.obj", "--max-error", "0.5", "--max-error-color", "4", "--stats"});
  EXPECT_NE(colors.out.find("objects.model.file=a.obj  (the meshes of a file are left unchanged"), std::string::npos) << colors.out;
}

TEST_F(ModelChoices, InfoDistinguishesUnusedAndMissingImages) {
  GltfBuilder file;
  write_png(directory / "used.png", Image<glm::u8vec4>(2, 3));
  for (const char* uri : {"used.png", "unused.png", "missing.png"}) file.add("images", {{"uri", uri}});
  for (const int image : {0, 2}) file.add("textures", {{"source", image}});
  file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"normalTexture", {{"index", 1}}}});
  file.mesh_node({{"attributes", {{"POSITION", file.triangle()}}}, {"material", 0}});
  write("a.gltf", file);
  const Outcome o = run({"info", "a.gltf"});
  EXPECT_NE(o.out.find("used.png (2x3), unused.png (unused), missing.png (unreadable)"), std::string::npos) << o.out;
  const Outcome turned = run({"info", "a.gltf", "--up-axis", "z", "--json"});
  EXPECT_EQ(nlohmann::json::parse(turned.out).at("up_axis"), "z");
  EXPECT_EQ(nlohmann::json::parse(turned.out).at("bounds").at("low").at(2), -1.0);  // y of the file
  EXPECT_EQ(run({"info", "a.gltf", "--up-axis", "x"}).exit_code, 2);
}

TEST_F(ModelChoices, UnusualArguments) {
  write_textured("a", "t.png");
  fs::copy_file(directory / "a.obj", directory / "-a.obj");
  EXPECT_EQ(render({"a.obj", "--floor", "-o", "floor.png"}).exit_code, 0);
  EXPECT_EQ(render({"a.obj", "-o", "default.png"}).exit_code, 0);
  EXPECT_TRUE(picture("floor.png") == picture("default.png"));
  EXPECT_EQ(render({"a.obj", "--floor", "--no-floor"}).exit_code, 2);
  EXPECT_EQ(run({"render", "--size", "32x32", "--", "-a.obj"}).exit_code, 0);
  const Outcome late = run({"render", "--", "-a.obj", "--size", "32x32"});
  EXPECT_EQ(late.exit_code, 3);
  EXPECT_NE(late.err.find("unknown scene '--size'"), std::string::npos) << late.err;
  for (const char* command : {"render", "explain", "export"}) {
    std::vector<std::string> words{command, ""};
    if (words[0] == "export") words.insert(words.end(), {"-o", "a.glb"});
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_EQ(lines_of(o.err), 1);
    EXPECT_NE(o.err.find("the name is empty"), std::string::npos) << o.err;
  }
}

TEST_F(ModelChoices, LargeModels) {
  const auto triangle = [](const char* size) { return std::string("v 0 0 0\nv ") + size + " 0 0\nv 0 " + size + " 0\nf 1 2 3\n"; };
  write("small.obj", triangle("1"));
  write("large.obj", triangle("1e12"));
  write("huge.obj", triangle("1e18"));
  EXPECT_EQ(render({"small.obj", "-o", "small.png"}).exit_code, 0);
  EXPECT_EQ(render({"large.obj", "-o", "large.png"}).exit_code, 0);
  EXPECT_EQ(picture("small.png").at(16, 16), picture("large.png").at(16, 16));
  const Outcome o = render({"huge.obj"});
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("huge.obj: the model is too large"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace halfspace
