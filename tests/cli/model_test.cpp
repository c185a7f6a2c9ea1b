// SPDX-License-Identifier: Apache-2.0
//
// Rendering of model files by the program.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class Models : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  // Returns a cube with the given center and edge length as OBJ text.
  static std::string cube(double center, double size) {
    std::ostringstream text;
    text.precision(17);
    for (int i = 0; i < 8; ++i) {
      const auto at = [&](int bit) { return center + size * ((i >> bit & 1) - 0.5); };
      text << "v " << at(0) << " " << at(1) << " " << at(2) << "\n";
    }
    text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    return text.str();
  }
  // Renders a cube and returns its picture.
  Image<glm::u8vec4> cube_picture(double center, double size) const {
    write("cube.obj", cube(center, size));
    const Outcome o = run({"render", "cube.obj", "--size", "160x90"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return picture("cube-render.png");
  }
};

TEST_F(Models, RenderWritesOnlyThePicture) {
  write("cube.obj", cube(0.0, 1.0));
  const Outcome o = run({"render", "cube.obj", "--size", "160x90"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(files(), (std::vector<std::string>{"cube-render.png", "cube.obj"}));
  const Image<glm::u8vec4> image = picture("cube-render.png");
  // The cube is brighter than the background at its top, and fills most of the height.
  const glm::u8vec4 background = image.at(2, 2);
  int rows = 0;
  for (int y = 0; y < image.height(); ++y) rows += image.at(80, y) != background;
  EXPECT_GE(rows, 60);
  EXPECT_LT(rows, 90);
}

TEST_F(Models, PositionAndSizeOfTheModelDoNotMatter) {
  const Image<glm::u8vec4> expected = cube_picture(0.0, 1.0);
  struct Case {
    double center, size;
  };
  for (const Case& c : {Case{5e6, 1.0}, Case{-5e6, 1.0}, Case{0.0, 1e-6}, Case{0.0, 1e-9}, Case{0.0, 1e6}}) {
    const Image<glm::u8vec4> other = cube_picture(c.center, c.size);
    int differ = 0;
    for (std::size_t i = 0; i < expected.texels().size(); ++i) {
      for (int k = 0; k < 3; ++k) differ += std::abs(int{expected.data()[i][k]} - int{other.data()[i][k]}) > 1;
    }
    // At most 1 % of the channels: the texels of the shadow map are aligned with the origin of the scene, so penumbras differ a little.
    EXPECT_LE(differ, 432) << c.center << " " << c.size;
  }
}

// Points and lines without a color of their own contrast with the background, and points are larger in small point clouds.
TEST_F(Models, PointsAndLinesAreVisible) {
  const auto dark_pixels = [&](const std::string& elements, const std::string& background) {
    std::string text = cube(0.0, 1.0);
    text = text.substr(0, text.find("f ")) + elements;
    write("points.obj", text);
    const Outcome o = run({"render", "points.obj", "--size", "320x180", "--no-floor", "--background", background});
    EXPECT_EQ(o.err, "");
    int count = 0;
    const Image<glm::u8vec4> image = picture("points-render.png");
    const int level = image.at(1, 1).x;
    for (const glm::u8vec4& t : image.texels()) count += std::abs(t.x - level) > 100 ? 1 : 0;
    return count;
  };
  EXPECT_GE(dark_pixels("p 1 2 3 4 5 6 7 8\n", "#ffffff"), 4 * 9);  // 3x3 pixels each; some may overlap
  EXPECT_GE(dark_pixels("p 1 2 3 4 5 6 7 8\n", "#000000"), 4 * 9);
  EXPECT_GE(dark_pixels("l 1 2 4 3 1 5 6 8 7 5\n", "#a0a0a0"), 100);
}

TEST_F(Models, ThreadsDoNotMatter) {
  write("cube.obj", cube(0.0, 1.0));
  EXPECT_EQ(run({"render", "cube.obj", "--size", "160x90", "--threads", "1", "-o", "one.png"}).exit_code, 0);
  EXPECT_EQ(run({"render", "cube.obj", "--size", "160x90", "--threads", "3", "-o", "three.png"}).exit_code, 0);
  EXPECT_EQ(read_bytes(directory / "one.png"), read_bytes(directory / "three.png"));
}

TEST_F(Models, OptionsChangeTheView) {
  write("cube.obj", cube(0.0, 1.0));
  EXPECT_EQ(run({"render", "cube.obj", "--size", "96x54", "-o", "default.png"}).exit_code, 0);
  const std::vector<std::vector<std::string>> views{{"--yaw", "80"},
                                                    {"--pitch", "60"},
                                                    {"--zoom", "2"},
                                                    {"--fov", "90"},
                                                    {"--eye", "3,3,3"},
                                                    {"--look-at", "0,0.4,0"},
                                                    {"--up", "1,0,0"},
                                                    {"--inside"},
                                                    {"--background", "#102030"},
                                                    {"--background", "environment"},
                                                    {"--no-floor"},
                                                    {"--up-axis", "z", "--pitch", "50"}};
  for (const std::vector<std::string>& view : views) {
    std::vector<std::string> words{"render", "cube.obj", "--size", "96x54", "-o", "view.png"};
    words.insert(words.end(), view.begin(), view.end());
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(read_bytes(directory / "default.png"), read_bytes(directory / "view.png")) << view[0];
  }
}

TEST_F(Models, TurntableRendersNumberedFrames) {
  write("cube.obj", cube(0.0, 1.0));
  EXPECT_EQ(run({"render", "cube.obj", "--size", "96x54", "--turntable", "4"}).exit_code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"cube-render_0000.png", "cube-render_0001.png", "cube-render_0002.png",
                                               "cube-render_0003.png", "cube.obj"}));
  // The lights stay in place while the camera moves around the model, so opposite views differ.
  EXPECT_NE(read_bytes(directory / "cube-render_0000.png"), read_bytes(directory / "cube-render_0002.png"));
}

TEST_F(Models, AreObjectsOfSceneFiles) {
  write("cube.obj", cube(0.0, 1.0));
  write("scene.json", R"({ "version": 1, "cameras": { "main": { "position": [2, 2, 3] } }, "lights": { "sun": { "direction": [1, 2, 3] } },
    "objects": { "cube": { "shape": "file", "file": "cube.obj", "instances": [ {}, { "position": [1.5, 0, 0] } ] } } })");
  const Outcome o = run({"render", "scene.json", "--size", "96x54", "--stats=json"});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(nlohmann::json::parse(o.out).at("counts").at("primitives_in"), 24);
}

TEST_F(Models, PrintedSceneRendersTheSamePicture) {
  write("cube.obj", cube(0.0, 1.0));
  const Outcome printed = run({"render", "cube.obj", "--size", "96x54", "--print"});
  write("scene.json", printed.out);
  EXPECT_EQ(run({"render", "scene.json", "--size", "96x54", "-o", "scene.png"}).exit_code, 0);
  EXPECT_EQ(run({"render", "cube.obj", "--size", "96x54", "-o", "model.png"}).exit_code, 0);
  EXPECT_TRUE(picture("scene.png") == picture("model.png"));
}

TEST_F(Models, InputFilesAreNotOverwritten) {
  write("a.mtl", "newmtl m\nmap_Kd a-render.png\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  Image<glm::u8vec4> texture(2, 2);
  write_png(directory / "a-render.png", texture);
  const std::string before = read_bytes(directory / "a-render.png");
  const Outcome o = run({"render", "a.obj", "--size", "96x54"});  // the texture has the name of the default output
  EXPECT_EQ(o.exit_code, 4);
  EXPECT_EQ(lines_of(o.err), 1);
  EXPECT_NE(o.err.find("a-render.png"), std::string::npos);
  EXPECT_EQ(read_bytes(directory / "a-render.png"), before);
}

// Two intersecting transparent quads in front of a wall.
std::string crossing_quads(const std::string& material) {
  return "mtllib m.mtl\nv -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nusemtl wall\nf 1 2 3 4\n"
         "v -1 -1 -1\nv 1 -1 1\nv 1 1 1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 1\n"
         "usemtl " +
         material + "\nf 5 6 7 8\nusemtl other\nf 9 10 11 12\n";
}

// Pixels left and right of the line where the quads cross show different quads in front.
TEST_F(Models, TransparentSurfacesMayIntersect) {
  write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl red\nKd 1 0 0\nd 0.5\nnewmtl other\nKd 0 0 1\nd 0.5\n");
  write("quads.obj", crossing_quads("red"));
  const Outcome o = run({"render", "quads.obj", "--size", "96x96", "--eye", "0,0,6", "--look-at", "0,0,0", "--fov", "30", "--no-floor"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Image<glm::u8vec4> image = picture("quads-render.png");
  const glm::u8vec4 left = image.at(36, 48), right = image.at(60, 48);  // red is nearer on the right
  EXPECT_GT(left.z, right.z + 20);
  EXPECT_GT(right.x, left.x + 20);
}

TEST_F(Models, ImagesOfModelsInSceneFilesAreNotOverwritten) {
  write("a.mtl", "newmtl m\nmap_Kd t.png\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  write_png(directory / "t.png", Image<glm::u8vec4>(2, 2));
  write("scene.json",
        R"({ "version": 1, "cameras": { "main": {} }, "ambient": 1, "objects": { "a": { "shape": "file", "file": "a.obj" } } })");
  const std::string before = read_bytes(directory / "t.png");
  EXPECT_EQ(run({"render", "scene.json", "--size", "96x54", "-o", "t.png"}).exit_code, 4);
  EXPECT_EQ(read_bytes(directory / "t.png"), before);
}

// A floor that no light reaches has no shadow.
TEST_F(Models, FloorSeenFromBelowIsInvisible) {
  write("cube.obj", cube(0.0, 1.0));
  EXPECT_EQ(run({"render", "cube.obj", "--size", "96x54", "--pitch", "-60", "-o", "floor.png"}).exit_code, 0);
  EXPECT_EQ(run({"render", "cube.obj", "--size", "96x54", "--pitch", "-60", "--no-floor", "-o", "none.png"}).exit_code, 0);
  const Image<glm::u8vec4> with = picture("floor.png"), without = picture("none.png");
  EXPECT_EQ(with.at(2, 27), without.at(2, 27));
  EXPECT_EQ(with.at(48, 27), without.at(48, 27));
}

TEST_F(Models, FilesOutsideTheFolderNeedPermission) {
  fs::create_directory(directory / "inner");
  write("m.mtl", "newmtl m\nKd 1 0 0\n");
  write("inner/a.obj", "mtllib ../m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome rejected = run({"render", "inner/a.obj", "--size", "96x54", "-o", "rejected.png"});
  EXPECT_EQ(rejected.exit_code, 0);
  EXPECT_EQ(lines_of(rejected.err), 1);
  EXPECT_NE(rejected.err.find("--allow-outside"), std::string::npos) << rejected.err;
  const Outcome allowed = run({"render", "inner/a.obj", "--size", "96x54", "-o", "allowed.png", "--allow-outside"});
  EXPECT_EQ(allowed.err, "");
  EXPECT_NE(read_bytes(directory / "rejected.png"), read_bytes(directory / "allowed.png"));
}

TEST_F(Models, InfoDescribesAModel) {
  write("cube.obj", cube(2.0, 1.0) + "f 1 3 4\n");
  const Outcome o = run({"info", "cube.obj", "--json"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const auto info = nlohmann::json::parse(o.out);
  EXPECT_EQ(info.at("format"), "OBJ");
  EXPECT_EQ(info.at("triangles"), 13);
  EXPECT_EQ(info.at("non_manifold_edges"), 2 + 1);  // two edges of the added triangle, and the diagonal of the quad
  EXPECT_EQ(info.at("bounds").at("low"), (std::vector<double>{1.5, 1.5, 1.5}));
}

TEST_F(Models, InfoListsImagesAndProblems) {
  write_image(directory / "a.png", Image<glm::u8vec4>(7, 5));
  write_image(directory / "b.jpg", Image<glm::u8vec4>(9, 4));
  write("c.png", "not an image");
  write("a.mtl", "newmtl m\nmap_Kd a.png\nmap_Ks b.jpg\nmap_d c.png\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 4/1\nf 1/1 2/1 3/1\n");
  const Outcome o = run({"info", "a.obj", "--json"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const auto info = nlohmann::json::parse(o.out);
  std::map<std::string, nlohmann::json> images;
  for (const auto& image : info.at("images")) images[image.at("name")] = image;
  EXPECT_EQ(images.at("a.png").at("width"), 7);
  EXPECT_EQ(images.at("a.png").at("height"), 5);
  EXPECT_EQ(images.at("b.jpg").at("width"), 9);
  EXPECT_EQ(images.at("b.jpg").at("height"), 4);
  EXPECT_TRUE(images.at("c.png").at("width").is_null());
  EXPECT_EQ(info.at("warnings").size(), 1u);
  EXPECT_EQ(info.at("degenerate_triangles"), 1);  // its vertices are collinear
  EXPECT_EQ(info.at("meshes_without_normals"), 1);
  const Outcome text = run({"info", "a.obj"});
  EXPECT_NE(text.out.find("a.png (7x5)"), std::string::npos) << text.out;
}

TEST_F(Models, BumpMapsTiltNormals) {
  Image<glm::u8vec4> heights(8, 8);  // ridges along v
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) heights.at(x, y) = glm::u8vec4(glm::u8vec3(x % 4 < 2 ? 0 : 255), 255);
  }
  write_image(directory / "bump.png", heights);
  const auto picture_with = [&](const std::string& map) {
    write("a.mtl", "newmtl m\nKs 0 0 0\nillum 1\n" + map);
    write("a.obj", "mtllib a.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    write("scene.json", R"({"version": 1, "cameras": {"c": {"type": "orthographic", "height": 2}},
      "lights": {"sun": {"direction": [1, 0, 1]}}, "objects": {"a": {"shape": "file", "file": "a.obj"}}})");
    const Outcome o = run({"render", "scene.json", "--size", "16x16", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    return picture("a.png");
  };
  const Image<glm::u8vec4> flat = picture_with(""), bumps = picture_with("map_bump -bm 8 bump.png\n");
  // The height rises at u = 1/4, so the normal tilts to -x, away from the light; it falls at u = 1/2, where the normal tilts to the light.
  EXPECT_EQ(flat.at(4, 8), flat.at(8, 8));
  EXPECT_LT(bumps.at(4, 8).x + 10, flat.at(4, 8).x);
  EXPECT_GT(bumps.at(8, 8).x, flat.at(8, 8).x + 10);
  const Image<glm::u8vec4> inverted = picture_with("map_bump -bm -8 bump.png\n");
  EXPECT_GT(inverted.at(4, 8).x, flat.at(4, 8).x + 10);
}

TEST_F(Models, TransparentVertexColorsCastFainterShadows) {
  const auto shadow = [&](const char* alpha) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n";
    for (const char* corner : {"-1 1 -1", "-1 1 1", "1 1 1", "1 1 -1"}) text += std::string(corner) + " 255 255 255 " + alpha + "\n";
    write("a.ply", text + "4 0 1 2 3\n");
    write("scene.json", R"({"version": 1, "cameras": {"c": {"position": [0, 3, 6]}},
      "lights": {"sun": {"direction": [0, 1, 0]}}, "shadow": {"method": "pcf7", "resolution": 512},
      "objects": {"floor": {"shape": "plane", "size": 6}, "a": {"shape": "file", "file": "a.ply", "receives_shadow": false}}})");
    EXPECT_EQ(run({"render", "scene.json", "--size", "32x32", "-o", "a.png"}).exit_code, 0);
    return int{picture("a.png").at(16, 16).x};
  };
  const int opaque = shadow("255"), half = shadow("128"), nearly_clear = shadow("10");
  EXPECT_LT(opaque + 20, half);
  EXPECT_LT(half + 20, nearly_clear);
}

TEST_F(Models, MistakesAreReportedInOneLine) {
  write("cube.obj", cube(0.0, 1.0));
  write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write("empty.obj", "");
  write("tiny.obj", cube(0.0, 1e-40));
  write("cube", cube(0.0, 1.0));
  write("scene.json", "// a comment\n{\"version\": 1}");
  struct WrongCommand {
    std::vector<std::string> words;
    int exit_code;
    std::string keyword;
  };
  const WrongCommand mistakes[] = {
      {{"render", "none.obj"}, 3, "none.obj"},
      {{"render", "bad.obj"}, 3, "bad.obj:4"},
      {{"render", "empty.obj"}, 3, "empty.obj"},
      {{"render", "tiny.obj"}, 3, "tiny.obj: the model is too small"},
      {{"render", "cube"}, 3, "cube: the format is not recognized"},
      {{"info", "none.glb"}, 3, "none.glb"},
      {{"info", "scene.json"}, 3, "scene.json: is a scene; expected a model file (use 'halfspace list scene.json'"},
      {{"render", "cube.obj", "--yaw", "much"}, 2, "--yaw"},
      {{"render", "cube.obj", "--eye", "1,2"}, 2, "--eye"},
      {{"render", "cube.obj", "--up-axis", "x"}, 2, "--up-axis"},
      {{"render", "cube.obj", "--turntable", "1"}, 2, "--turntable"},
      {{"render", "cube.obj", "--turntable", "4", "--frames", "0..3"}, 2, "--turntable"},
      {{"render", "cube.obj", "--animation", "walk"}, 3, "walk"},
      {{"render", "cube.obj", "--environment", "none.hdr"}, 3, "none.hdr"},
      {{"render", "moon", "--yaw", "10"}, 2, "--yaw"},
      {{"render", "cube.obj", "--camera", "back"}, 3, "back"},
  };
  for (const WrongCommand& m : mistakes) {
    std::vector<std::string> words = m.words;
    if (words[0] == "render") words.insert(words.end(), {"--size", "32x18"});
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, m.exit_code) << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_NE(o.err.find(m.keyword), std::string::npos) << o.err;
  }
}

// One line says so if nothing is visible, and what to try. Whatever shows something is not reported.
TEST_F(Models, EmptyPicturesAreReported) {
  write("cube.obj", cube(0.0, 1.0));
  const auto message = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--size", "32x18", "-o", "a.png"});
    const Outcome o = run(words);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_LE(lines_of(o.err), 1) << o.err;
    return o.err;
  };
  const std::string start = "halfspace: warning: nothing is visible in the picture; try ";
  const auto suggests = [&](const std::vector<std::string>& words, const std::string& keyword) {
    const std::string text = message(words);
    EXPECT_TRUE(text.starts_with(start) && text.find(keyword, start.size()) != std::string::npos) << text;
  };
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  suggests({"flat.obj", "--inside"}, "--inside");  // the camera sees its edge
  suggests({"cube.obj", "--eye", "0,0,5", "--look-at", "0,0,9"}, "--eye");
  suggests({"cube.obj", "--no-floor", "--crop", "0,0,2,2"}, "--crop");
  EXPECT_EQ(message({"flat.obj", "--inside", "--background", "environment"}), "") << "the environment is visible";
  EXPECT_EQ(message({"cube.obj"}), "");
  write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n");
  EXPECT_EQ(message({"points.obj", "--no-floor"}), "");
  write("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n");
  EXPECT_EQ(message({"lines.obj", "--no-floor"}), "");
  write("glass.mtl", "newmtl m\nd 0.1\n");
  write("glass.obj", "mtllib glass.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(message({"glass.obj", "--no-floor", "--yaw", "0", "--pitch", "0"}), "");
  const auto scene = [](const std::string& target, const std::string& more) {
    return R"({"version": 1, "lights": {"l": {}}, "cameras": {"c": {"position": [0, 0, 5], "target": )" + target + "}}" + more + "}";
  };
  const std::string object = R"(, "objects": {"a": {"shape": "cube"}})", away = "[0, 0, 9]", ahead = "[0, 0, 0]";
  write("away.json", scene(away, object));
  suggests({"away.json"}, "target");
  suggests({"away.json", "--set", "background.type=transparent"}, "target");
  suggests({"away.json", "--set", "post.hdr=true"}, "target");
  suggests({"away.json", "--frames", "0..1"}, "target");
  std::filesystem::remove(directory / "a_0001.png");
  EXPECT_EQ(message({"away.json", "--frames", "0..1", "--resume"}), "halfspace: kept 1 picture, rendered 1: 1 missing\n")
      << "the frame that exists may show something";
  EXPECT_EQ(message({"away.json", "--set", "background.type=stars"}), "");
  write("ahead.json", scene(ahead, object));
  EXPECT_EQ(message({"ahead.json"}), "");
  write("particles.json", scene(ahead, R"(, "particles": {"count": 100})"));
  EXPECT_EQ(message({"particles.json"}), "");
  write("none.json", scene(away, ""));
  suggests({"none.json"}, "objects or particles");
  // Some frames of an animation may be empty.
  write("moving.json",
        scene(ahead, object + R"(, "animations": {"m": {"type": "rate", "target": "objects.a.position", "rate": [9000, 0, 0]}})"));
  EXPECT_EQ(message({"moving.json", "--frames", "0..1"}), "");
  suggests({"moving.json", "--frames", "1..2"}, "camera");
}

// Model files that have nothing to draw, with what is missing.
TEST_F(Models, TheReasonForAnEmptyModelIsReported) {
  const std::string asset = R"({"asset": {"version": "2.0"})";
  const std::string mesh = R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}])";
  const auto message = [&](const std::string& rest) {
    write("a.gltf", asset + rest + "}");
    const Outcome o = run({"render", "a.gltf", "--size", "32x18"});
    EXPECT_EQ(o.exit_code, 3);
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    EXPECT_NE(o.err.find("; expected "), std::string::npos) << o.err;
    return o.err;
  };
  EXPECT_NE(message("").find("a.gltf: has no meshes"), std::string::npos);
  EXPECT_NE(message(R"(, "nodes": [{}])").find("has no meshes"), std::string::npos);
  EXPECT_NE(message(mesh).find("has meshes, but no nodes"), std::string::npos);
  EXPECT_NE(message(mesh + R"(, "nodes": [{"mesh": 0}], "scenes": [{}, {"nodes": [0]}])").find("scenes[0] has no nodes"),
            std::string::npos);
  EXPECT_NE(message(mesh + R"(, "nodes": [{"mesh": 0}, {}], "scenes": [{"nodes": [1]}, {}])").find("scenes[0] draws no mesh"),
            std::string::npos);
  EXPECT_NE(message(mesh + R"(, "nodes": [{}])").find("a.gltf: draws no mesh"), std::string::npos) << "the file has no scenes";
  // The warning about the node of the other scene is not the reason.
  const std::string other =
      message(mesh + R"(, "nodes": [{"mesh": 0, "scale": [1, 0, 1]}, {}], "scenes": [{"nodes": [1]}, {"nodes": [0]}])");
  EXPECT_NE(other.find("scenes[0] draws no mesh"), std::string::npos) << other;
  EXPECT_NE(message(R"(, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {}}]}])")
                .find("meshes[0].primitives[0]: has no positions"),
            std::string::npos);
}

TEST_F(Models, PathsAndWarningsArePrintable) {
  write("bad\nname.obj", "v 0 0\n");
  const Outcome line = run({"render", "bad\nname.obj", "--size", "32x18", "-o", "a.png"});
  EXPECT_EQ(line.exit_code, 3);
  EXPECT_TRUE(line.err.starts_with("halfspace: bad\\x0aname.obj:1: ")) << line.err;
  EXPECT_EQ(lines_of(line.err), 1);
  write("bad\nname.obj", cube(0.0, 1.0));
  EXPECT_NE(run({"info", "bad\nname.obj"}).out.find("bad\\x0aname.obj\n"), std::string::npos);
  // A warning that quotes a name from the file.
  write("a.obj", "mtllib x\x1b\xff.mtl\n" + cube(0.0, 1.0));
  const Outcome o = run({"render", "a.obj", "--size", "32x18", "-o", "a.png"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.err.find("\\xff.mtl"), std::string::npos) << o.err;
  EXPECT_EQ(o.err.find('\x1b'), std::string::npos);
}

// Paths are bytes, which need not be UTF-8: of the model, of files that it refers to, and of the output.
TEST_F(Models, PathsMayContainAnyBytes) {
  Image<glm::u8vec4> red(2, 2);
  std::fill_n(red.data(), red.texels().size(), glm::u8vec4(255, 0, 0, 255));
  write_image(directory / "red\xe9.png", red);
  write("m\xe9.mtl", "newmtl red\nillum 0\nmap_Kd red\xe9.png\n");
  const std::string quad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl red\nf 1/1 2/2 3/3 4/1\n";
  fs::create_directory(directory / "d\xff");
  for (const std::string name : {"a\xe9.obj", "a\n.obj", "a\xc3\xa9.obj"}) {
    write(name, "mtllib m\xe9.mtl\n" + quad);
    const std::string output = "d\xff/" + name + ".png";
    const Outcome o = run({"render", name, "--size", "32x32", "--yaw", "0", "--pitch", "0", "-o", output});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(read_image(directory / output).at(16, 16), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(run({"compare", output, output}).exit_code, 0);
    EXPECT_EQ(run({"info", name, "--json"}).exit_code, 0);
    EXPECT_EQ(run({"export", name, "-o", "d\xff/b.glb"}).exit_code, 0);
    write("scene.json", run({"render", name, "--print"}).out);
    EXPECT_EQ(run({"render", "scene.json", "--size", "32x32", "-o", "b.png"}).exit_code, 0);
  }
}

// Only normal maps need the tangents that this model does not have.
TEST_F(Models, ReplacedMaterialsKeepTheirBumpMaps) {
  Image<glm::u8vec4> bumps(16, 16);
  for (int i = 0; i < 256; ++i) bumps.at(i % 16, i / 16) = glm::u8vec4(i * 37 % 256, 0, 0, 255);
  write_image(directory / "bumps.png", bumps);
  write("a.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
  const auto drawn = [&](const std::string& keys) {
    write("scene.json", R"({"version": 1, "lights": {"sun": {"direction": [1, 2, 3]}}, "materials": {"m": {"color": [1, 1, 1])" + keys +
                            R"(}}, "objects": {"a": {"shape": "file", "file": "a.obj", "material": "m"}}})");
    const Outcome o = run({"render", "scene.json", "--size", "64x64", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return std::pair(picture("a.png").at(30, 30), o.err);
  };
  const auto flat = drawn(""), bumped = drawn(R"(, "bump_map": "bumps.png", "bump_scale": 0.2)");
  EXPECT_NE(flat.first, bumped.first);
  EXPECT_EQ(bumped.second, "");
  EXPECT_NE(drawn(R"(, "normal_map": "bumps.png")").second.find("without normal maps"), std::string::npos);
}

}  // namespace
}  // namespace halfspace
