// SPDX-License-Identifier: Apache-2.0
//
// Exports scenes and models, and renders the results.
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/cli_run.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class Export : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  void export_to(const std::string& scene, const std::string& file) const {
    const Outcome o = run({"export", scene, "-o", file});
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(lines_of(o.err), file.ends_with(".obj") ? 1 : 0) << o.err;  // OBJ stores no lights
  }
  Image<glm::u8vec4> render(const std::string& scene) const {
    const Outcome o = run({"render", scene, "--size", "320x180", "-o", "picture.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return read_image(directory / "picture.png");
  }
};

// A scene with cameras and lights. The sun is the only light, because ambient light is not exported.
const std::string kHead = R"({"version": 1, "cameras": {"c": {"position": [2, 3, 6], "target": [0, 0.3, 0]}},
  "lights": {"sun": {"direction": [1, 2, 2], "intensity": 1.2}}, "objects": {)";

// Except for rounding to float, this scene is exported without loss: diffuse lighting, textures, instances and all kinds of placement.
const std::string kObjects = R"(
  "floor": {"shape": "plane", "size": 6, "segments": 2, "position": [0, -1, 0], "color": "map.png", "specular": 0},
  "ball": {"shape": "uv_sphere", "radius": 0.7, "color": [0.8, 0.3, 0.2], "position": [-1.5, 0, 0], "rotation": [10, 20, 30]},
  "boxes": {"shape": "cube", "size": 0.8, "diffuse": 0.7, "position": [1, 0, 0], "rotation": [0, 30, 0], "scale": [1, 1.5, 1],
            "instances": [{}, {"position": [1.2, 0, 0], "rotation": [0, 0, 40]}, {"position": [0, 1.2, 0], "scale": [-0.5, 0.5, 0.7]}]},
  "lamp": {"shape": "torus", "radius": 0.5, "tube": 0.2, "position": [0, 1, -1], "rotation": [60, 0, 0], "emissive": [0.1, 0.2, 0.4]},
  "top": {"shape": "cube", "size": 0.3, "parent": "ball", "position": [0, 0.9, 0]},
  "flat": {"shape": "icosphere", "level": 1, "radius": 0.6, "position": [0, 0, 1.5], "shading": "flat"})";

// Returns a scene that shows an exported file with the same camera and light.
std::string shown(const std::string& file, const std::string& more = "") {
  return kHead + R"("model": {"shape": "file", "file": ")" + file + "\"" + more + "}}}";
}

TEST_F(Export, RenderOfTheExportMatches) {
  Image<glm::u8vec4> map(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) map.at(x, y) = {16 * x, 16 * y, (x + y) % 2 * 255, 255};
  }
  write_image(directory / "map.png", map);
  write("scene.json", kHead + kObjects + "}}");
  const Image<glm::u8vec4> expected = render("scene.json");
  for (const std::string file : {"a.glb", "b.gltf", "c.obj"}) {
    export_to("scene.json", file);
    write("again.json", shown(file));
    const ImageDifference d = compare_images(expected, render("again.json"));
    // Rounding of positions moves silhouettes, which changes a few pixels. Rounding of normals and the converted reflection model change
    // shading by 1/255.
    EXPECT_LT(d.mean, 2e-3) << file;
    EXPECT_LT(d.share_above, 0.01) << file;
  }
}

// The texture is minified anisotropically. The line has no material.
TEST_F(Export, ModelsKeepTheirPicture) {
  Image<glm::u8vec4> map(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) map.at(x, y) = {4 * x, 4 * y, (x + y) % 2 * 255, 255};
  }
  write_image(directory / "map.png", map);
  write("a.mtl", "newmtl m\nKd 0.8 0.7 0.6\nmap_Kd map.png\n");
  write("a.obj",
        "mtllib a.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nv 0 1 0\nvt 0 0\nvt 6 0\nvt 6 6\nvt 0 6\nl 1 5 3\n"
        "usemtl m\nf 4/4 3/3 2/2 1/1\n");
  export_to("a.obj", "b.glb");
  EXPECT_EQ(render("a.obj"), render("b.glb"));
}

TEST_F(Export, KeepsCamerasAndLights) {
  write("scene.json", kHead + R"("ball": {"shape": "sphere"}}})");
  export_to("scene.json", "a.glb");
  const Outcome o = run({"info", "a.glb", "--json"});
  const auto info = nlohmann::json::parse(o.out);
  EXPECT_EQ(info.at("cameras"), std::vector<std::string>{"c"});
  EXPECT_EQ(info.at("lights"), std::vector<std::string>{"sun"});
  EXPECT_EQ(info.at("triangles"), 20 << 10);
  EXPECT_EQ(info.at("warnings"), nlohmann::json::array());
  export_to("scene.json", "a.gltf");
  const auto gltf = nlohmann::json::parse(read_bytes(directory / "a.gltf"));
  EXPECT_NEAR(gltf.at("extensions").at("KHR_lights_punctual").at("lights")[0].at("intensity").get<double>(), 1.2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(gltf.at("cameras")[0].at("perspective").at("yfov").get<double>(), std::numbers::pi / 4.0, 1e-12);
  std::map<std::string, std::vector<double>> matrices;
  for (const auto& node : gltf.at("nodes")) {
    if (node.contains("matrix")) matrices[node.at("name")] = node.at("matrix").get<std::vector<double>>();
  }
  // The z axes point backwards: toward the light, and from the target to the eye.
  for (std::size_t k = 0; k < 3; ++k) {
    const double to_light[] = {1.0, 2.0, 2.0}, to_eye[] = {2.0, 2.7, 6.0}, eye[] = {2.0, 3.0, 6.0};
    EXPECT_NEAR(matrices.at("sun")[8 + k], to_light[k] / 3.0, 1e-12);
    EXPECT_NEAR(matrices.at("c")[8 + k], to_eye[k] / std::sqrt(4.0 + 2.7 * 2.7 + 36.0), 1e-12);
    EXPECT_NEAR(matrices.at("c")[12 + k], eye[k], 1e-12);
  }
}

TEST_F(Export, ModelsAreConverted) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  for (const std::string file : {"b.glb", "b.gltf", "b.ply", "b.stl", "c.obj"}) {
    EXPECT_EQ(run({"export", "a.obj", "-o", file}).exit_code, 0) << file;
    const auto info = nlohmann::json::parse(run({"info", file, "--json"}).out);
    EXPECT_EQ(info.at("triangles"), 2) << file;
    EXPECT_EQ(info.at("bounds").at("high"), (std::vector<double>{1, 1.5, 1})) << file;
  }
}

TEST_F(Export, WarnsAboutOmissions) {
  const Outcome o = run({"export", "day-night", "-o", "a.glb"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.err.find("environments and backgrounds are omitted"), std::string::npos) << o.err;
}

// OBJ, PLY and STL store no lights, so nothing is lost by converting them.
TEST_F(Export, WarnsAboutLightsOnlyIfTheFormatStoresThem) {
  write("scene.json", R"({"version": 1, "lights": {"lamp": {"type": "point", "specular": 0.5}}, "objects": {"a": {"shape": "cube"}}})");
  for (const std::string file : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl"}) {
    const Outcome o = run({"export", "scene.json", "-o", file});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    const bool is_gltf = file.starts_with("a.gl");
    EXPECT_EQ(o.err.find("physical falloff") != std::string::npos, is_gltf) << file << ": " << o.err;
    EXPECT_EQ(o.err.find("diffuse and specular light") != std::string::npos, is_gltf) << file << ": " << o.err;
  }
}

TEST_F(Export, RejectsScenesWithoutMeshes) {
  for (const char* file : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl"}) {
    const Outcome o = run({"export", "particles", "-o", file});
    EXPECT_EQ(o.exit_code, 3) << file;
    EXPECT_EQ(o.err, "halfspace: particles: has no meshes to export; expected at least one (particles are not exported)\n");
    EXPECT_FALSE(fs::exists(directory / file));
  }
}

TEST_F(Export, WarningsOfReadersNameTheModelFile) {
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("a.mtl", "newmtl m\nKd x\n");
  write("scene.json", R"({"version": 1, "objects": {"a": {"shape": "file", "file": "a.obj"}}})");
  for (const std::string input : {"a.obj", "scene.json"}) {
    const Outcome o = run({"export", input, "-o", "b.glb"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.err.find("a.obj: a.mtl:2: "), std::string::npos) << o.err;
  }
}

TEST_F(Export, WarnsAboutLossesOfModelObjects) {
  write("a.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}, {"componentType": 5126, "count": 1, "type": "SCALAR"}],
    "animations": [{"name": "walk", "samplers": [{"input": 1, "output": 1}], "channels": []}]})");
  write("scene.json", R"({"version": 1, "materials": {"red": {"color": [1, 0, 0]}}, "objects": {
    "a": {"shape": "file", "file": "a.gltf", "material": "red", "model_animation": "walk", "model_time": 1}}})");
  const Outcome o = run({"export", "scene.json", "-o", "b.glb"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.err.find("materials that replace those of model files"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("model_time"), std::string::npos) << o.err;
}

// Scenes are not lit by the lights of the models that they draw.
TEST_F(Export, OmitsTheLightsOfModelObjects) {
  write("scene.json", kHead + R"("floor": {"shape": "plane", "size": 3}}})");
  export_to("scene.json", "a.gltf");
  write("again.json", shown("a.gltf", R"(, "instances": [{}, {"position": [3, 0, 0]}])"));
  export_to("again.json", "b.gltf");
  for (const std::string file : {"a.gltf", "b.gltf"})
    EXPECT_EQ(nlohmann::json::parse(run({"info", file, "--json"}).out).at("lights"), std::vector<std::string>{"sun"}) << file;
}

// A point light with physical falloff has the same range in the exported file and in a scene that is made of the file.
TEST_F(Export, KeepsTheRangeOfLights) {
  const std::string head = R"({"version": 1, "cameras": {"c": {"position": [0, 4, 0.1]}}, "lights": {"lamp": {"type": "point",
    "position": [0.3, 0.5, 0], "falloff": "physical", "range": 1.25}}, "objects": {)";
  write("scene.json", head + R"("floor": {"shape": "plane", "size": 3}}})");
  export_to("scene.json", "a.gltf");
  const auto gltf = nlohmann::json::parse(read_bytes(directory / "a.gltf"));
  EXPECT_EQ(gltf.at("extensions").at("KHR_lights_punctual").at("lights")[0].at("range"), 1.25);
  const auto info = nlohmann::json::parse(run({"info", "a.gltf", "--json"}).out);
  EXPECT_EQ(info.at("warnings"), nlohmann::json::array());
  // The scene that draws the file converts lengths to its own units: the floor is 3 units wide there as well if its scale is 1.
  const auto scene = nlohmann::json::parse(run({"render", "a.gltf", "--print"}).out);
  const double scale =
      scene.at("objects").at("model").contains("scale") ? scene.at("objects").at("model").at("scale")[0].get<double>() : 1.0;
  EXPECT_DOUBLE_EQ(scene.at("lights").at("lamp").at("range").get<double>(), 1.25 * scale);
}

TEST_F(Export, NeverReplacesAFileThatItReads) {
  write("a.mtl", "newmtl m\nKd 1 0 0\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("b.obj", "mtllib c.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("c.mtl", "newmtl m\nKd 0 1 0\n");
  const std::string before = read_bytes(directory / "c.mtl");
  for (const auto& [in, out] : {std::pair("a.obj", "a.obj"), std::pair("b.obj", "c.obj")}) {
    const Outcome o = run({"export", in, "-o", out});
    EXPECT_EQ(o.exit_code, 4) << in;
    EXPECT_EQ(lines_of(o.err), 1);
  }
  EXPECT_EQ(read_bytes(directory / "c.mtl"), before);
  EXPECT_FALSE(fs::exists(directory / "c.obj"));
  // Rendering must not overwrite a material library.
  write("d.png", "newmtl m\n");
  write("d.obj", "mtllib d.png\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run({"render", "d.obj", "--size", "32x32", "-o", "d.png"}).exit_code, 4);
}

TEST_F(Export, RejectsOtherFormats) {
  EXPECT_EQ(run({"export", "shapes", "-o", "a.fbx"}).exit_code, 2);
  EXPECT_EQ(run({"export", "shapes"}).exit_code, 2);
  EXPECT_EQ(run({"export", "none.obj", "-o", "a.glb"}).exit_code, 3);
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run({"export", "a.obj", "--set", "samples=4", "-o", "a.glb"}).exit_code, 2);
}

}  // namespace
}  // namespace halfspace
