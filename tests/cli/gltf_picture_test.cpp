// SPDX-License-Identifier: Apache-2.0
//
// Renders a small file for each glTF feature and compares the result with a known picture. The camera looks along -z at the square [-4,
// 4]²; a unit is one pixel.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"
#include "model/gltf_builder.h"

namespace halfspace {
namespace {

using Art = std::vector<std::string>;

class GltfPicture : public Cli {
 protected:
  // Renders the file and returns its pixels as letters: R, G, B, W, H (half of white, linear) and '.' for the background.
  Art art(const GltfBuilder& file, const std::string& keys = "") const {
    std::ofstream(directory / "a.gltf") << file.text();
    std::ofstream(directory / "scene.json") << R"({"version": 1, "cameras": {"c": {"type": "orthographic", "height": 8}}, "ambient": 1,
               "objects": {"model": {"shape": "file", "file": "a.gltf")"
                                            << keys << "}}}";
    const Outcome o = run({"render", "scene.json", "--size", "8x8", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    const Image<glm::u8vec4> image = read_image(directory / "a.png");
    Art rows;
    for (int y = 0; y < 8; ++y) {
      std::string& row = rows.emplace_back();
      for (int x = 0; x < 8; ++x) row += letter(image.at(x, y));
    }
    const std::string warning = "halfspace: warning: nothing is visible in the picture";
    EXPECT_TRUE(rows == Art(8, "........") ? o.err.starts_with(warning) : o.err.empty()) << o.err;
    return rows;
  }

  static char letter(const glm::u8vec4& p) {
    const std::pair<glm::u8vec4, char> letters[] = {{{0, 0, 0, 255}, '.'},   {{255, 0, 0, 255}, 'R'},     {{0, 255, 0, 255}, 'G'},
                                                    {{0, 0, 255, 255}, 'B'}, {{255, 255, 255, 255}, 'W'}, {{188, 188, 188, 255}, 'h'}};
    for (const auto& [color, name] : letters) {
      if (color == p) return name;
    }
    return '?';
  }

  // A texture of 2x2 texels: red, green / blue, white.
  int four_colors(GltfBuilder& file, uint8_t left_alpha = 255) const {
    Image<glm::u8vec4> image(2, 2);
    image.at(0, 0) = {255, 0, 0, left_alpha};
    image.at(1, 0) = {0, 255, 0, 255};
    image.at(0, 1) = {0, 0, 255, left_alpha};
    image.at(1, 1) = {255, 255, 255, 255};
    write_png(directory / "colors.png", image);
    file.add("images", {{"uri", "colors.png"}});
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    return file.add("textures", {{"source", 0}, {"sampler", 0}});
  }
  static int unlit(GltfBuilder& file, GltfJson properties) {
    properties["extensions"]["KHR_materials_unlit"] = GltfJson::object();
    return file.add("materials", std::move(properties));
  }
  // The square [-2, 2]², counter-clockwise from +z.
  static const std::vector<float>& corners() {
    static const std::vector<float> values{-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0};
    return values;
  }
  static GltfJson square(GltfBuilder& file, int material) {
    return {{"attributes", {{"POSITION", file.accessor(corners(), 3)}, {"TEXCOORD_0", file.accessor(uvs(), 2)}}},
            {"indices", file.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, 1)},
            {"material", material}};
  }
  static const std::vector<float>& uvs() {
    static const std::vector<float> values{0, 1, 1, 1, 1, 0, 0, 0};
    return values;
  }
  // A node with a white square.
  static int white_square(GltfBuilder& file) { return file.mesh_node(square(file, unlit(file, GltfJson::object()))); }
};

// Returns a picture with four equal rows in the middle; all other rows are empty.
Art middle(const std::string& row) { return {"........", "........", row, row, row, row, "........", "........"}; }

const Art kColors{"........", "........", "..RRGG..", "..RRGG..", "..BBWW..", "..BBWW..", "........", "........"};
const Art kMirrored{"........", "........", "..GGRR..", "..GGRR..", "..WWBB..", "..WWBB..", "........", "........"};

TEST_F(GltfPicture, TextureIsUpright) {
  GltfBuilder file;
  file.mesh_node(square(file, unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", four_colors(file)}}}}}})));
  EXPECT_EQ(art(file), kColors);
}

TEST_F(GltfPicture, SecondSetOfTextureCoordinates) {
  GltfBuilder file;
  GltfJson mesh =
      square(file, unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", four_colors(file)}, {"texCoord", 1}}}}}}));
  mesh["attributes"]["TEXCOORD_1"] = file.accessor<float>({1, 1, 0, 1, 0, 0, 1, 0}, 2);
  file.mesh_node(mesh);
  EXPECT_EQ(art(file), kMirrored);
}

TEST_F(GltfPicture, NormalizedTextureCoordinates) {
  GltfBuilder file;
  GltfJson mesh = square(file, unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", four_colors(file)}}}}}}));
  mesh["attributes"]["TEXCOORD_0"] = file.accessor<uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}, 2, true);
  file.mesh_node(mesh);
  EXPECT_EQ(art(file), kColors);
}

TEST_F(GltfPicture, TextureTransform) {
  const auto transformed = [&](const GltfJson& transform) {
    GltfBuilder file;
    const GltfJson use = {{"index", four_colors(file)}, {"extensions", {{"KHR_texture_transform", transform}}}};
    file.mesh_node(square(file, unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", use}}}})));
    return art(file);
  };
  EXPECT_EQ(transformed({{"offset", {0.5, 0.0}}}), kMirrored);
  EXPECT_EQ(transformed({{"scale", {-1.0, 1.0}}}), kMirrored);
  // A rotation of the coordinates by 90° counter-clockwise turns the image clockwise.
  const Art turned{"........", "........", "..BBRR..", "..BBRR..", "..WWGG..", "..WWGG..", "........", "........"};
  EXPECT_EQ(transformed({{"rotation", 1.5707963267948966}, {"offset", {0.0, 1.0}}}), turned);
}

TEST_F(GltfPicture, MaskAndBlend) {
  GltfBuilder mask;
  const GltfJson texture = {{"baseColorTexture", {{"index", four_colors(mask, 100)}}}};
  mask.mesh_node(square(mask, unlit(mask, {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", texture}})));
  const Art right{"........", "........", "....GG..", "....GG..", "....WW..", "....WW..", "........", "........"};
  EXPECT_EQ(art(mask), right);
  GltfBuilder blend;
  blend.mesh_node(square(blend, unlit(blend, {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}})));
  EXPECT_EQ(art(blend), middle("..hhhh.."));
}

// All faces of the mesh face the camera. They must not be culled if the node is mirrored.
TEST_F(GltfPicture, NegativeScaleMirrors) {
  GltfBuilder file;
  const int node =
      file.mesh_node(square(file, unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", four_colors(file)}}}}}})));
  file.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {-1, 1, 1};
  EXPECT_EQ(art(file), kMirrored);
  file.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {-1, 1, -1};  // the back
  EXPECT_EQ(art(file), middle("........"));
}

TEST_F(GltfPicture, Instances) {
  GltfBuilder file;
  const int node = white_square(file);
  file.json["nodes"][static_cast<std::size_t>(node)]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.accessor<float>({-2, 0, 0, 3, 0, 0}, 3)}, {"SCALE", file.accessor<float>({1, 1, 1, 0.5, 1, 1}, 3)}};
  EXPECT_EQ(art(file), middle("WWWW..WW"));
}

// Quantized positions are integers; the node's transform scales them.
TEST_F(GltfPicture, QuantizedPositions) {
  GltfBuilder file;
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  std::vector<int16_t> corners;
  for (const float x : GltfPicture::corners()) corners.push_back(static_cast<int16_t>(x * 1000.0f));
  for (std::size_t i = 4; i > 0; --i) corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(3 * i), 0);  // rows of 8 bytes
  const int view = file.view(corners, 8);
  const int positions = file.add("accessors", {{"bufferView", view}, {"componentType", 5122}, {"count", 4}, {"type", "VEC3"}});
  const int node = file.mesh_node({{"attributes", {{"POSITION", positions}}},
                                   {"indices", file.accessor<uint8_t>({0, 1, 2, 0, 2, 3}, 1)},
                                   {"material", unlit(file, GltfJson::object())}});
  file.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {0.001, 0.001, 0.001};
  EXPECT_EQ(art(file), middle("..WWWW.."));
}

TEST_F(GltfPicture, SparseAndInterleavedAccessors) {
  GltfBuilder file;
  const int base = file.accessor<float>({9, 9, 9, 2, -2, 0, 2, 2, 0, -2, 2, 0}, 3);
  file.json["accessors"][static_cast<std::size_t>(base)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", file.view(std::vector<uint16_t>{0})}, {"componentType", 5123}}},
      {"values", {{"bufferView", file.view(std::vector<float>{-2, -2, 0})}}}};
  std::vector<float> rows;  // two interleaved attributes
  for (std::size_t i = 0; i < 4; ++i) rows.insert(rows.end(), {uvs()[2 * i], uvs()[2 * i + 1], 7.0f});
  const int interleaved =
      file.add("accessors", {{"bufferView", file.view(rows, 12)}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  const int material = unlit(file, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", four_colors(file)}}}}}});
  file.mesh_node({{"attributes", {{"POSITION", base}, {"TEXCOORD_0", interleaved}}},
                  {"indices", file.accessor<uint32_t>({0, 1, 2, 0, 2, 3}, 1)},
                  {"material", material}});
  EXPECT_EQ(art(file), kColors);
}

TEST_F(GltfPicture, EveryInterpolation) {
  const auto at = [&](const char* interpolation, const std::vector<float>& values, const char* time) {
    GltfBuilder file;
    const int node = white_square(file);
    const GltfJson sampler = {
        {"input", file.accessor<float>({0, 1}, 1)}, {"output", file.accessor(values, 3)}, {"interpolation", interpolation}};
    const GltfJson channel = {{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}};
    file.add("animations", {{"name", "move"}, {"samplers", {sampler}}, {"channels", {channel}}});
    return art(file, std::string(R"(, "model_animation": "move", "model_time": )") + time)[3];
  };
  const std::vector<float> line{-2, 0, 0, 2, 0, 0};
  EXPECT_EQ(at("STEP", line, "0.9"), "WWWW....");
  EXPECT_EQ(at("STEP", line, "1"), "....WWWW");
  EXPECT_EQ(at("LINEAR", line, "0"), "WWWW....");
  EXPECT_EQ(at("LINEAR", line, "0.25"), ".WWWW...");
  EXPECT_EQ(at("LINEAR", line, "0.75"), "...WWWW.");
  // Hermite splines: with tangents 0 the value at 1/2 is the mean. An out-tangent of 16 adds 16 (t³ - 2t² + t) = 2.
  EXPECT_EQ(at("CUBICSPLINE", {0, 0, 0, -2, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0}, "0.5"), "..WWWW..");
  EXPECT_EQ(at("CUBICSPLINE", {0, 0, 0, -2, 0, 0, 16, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0}, "0.5"), "....WWWW");
}

TEST_F(GltfPicture, MorphTargets) {
  GltfBuilder file;
  GltfJson mesh = square(file, unlit(file, GltfJson::object()));
  mesh["targets"] = {{{"POSITION", file.accessor<float>({2, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0}, 3)}},
                     {{"POSITION", file.accessor<float>({0, 0, 0, 4, 0, 0, 4, 0, 0, 0, 0, 0}, 3)}}};
  const int node = file.mesh_node(mesh);
  file.json["nodes"][static_cast<std::size_t>(node)]["weights"] = {1.0, 0.25};
  EXPECT_EQ(art(file), middle("....WWW."));
}

// Joints 0 to 4 do not move. Joint 5, which is in the second set, moves by 4; with a weight of 1/2, it moves the square by 2.
TEST_F(GltfPicture, SkinsWithMoreThanFourJoints) {
  GltfBuilder file;
  GltfJson mesh = square(file, unlit(file, GltfJson::object()));
  std::vector<uint8_t> joints, more_joints;
  std::vector<float> weights, more_weights;
  for (int i = 0; i < 4; ++i) {
    joints.insert(joints.end(), {0, 1, 2, 3});
    more_joints.insert(more_joints.end(), {4, 5, 0, 0});
    weights.insert(weights.end(), {0.125f, 0.125f, 0.125f, 0.0f});
    more_weights.insert(more_weights.end(), {0.125f, 0.5f, 0.0f, 0.0f});
  }
  mesh["attributes"]["JOINTS_0"] = file.accessor(joints, 4);
  mesh["attributes"]["WEIGHTS_0"] = file.accessor(weights, 4);
  mesh["attributes"]["JOINTS_1"] = file.accessor(more_joints, 4);
  mesh["attributes"]["WEIGHTS_1"] = file.accessor(more_weights, 4);
  const int node = file.mesh_node(mesh);
  GltfJson list = GltfJson::array();
  for (int i = 0; i < 6; ++i) list.push_back(file.add("nodes", {{"translation", {i == 5 ? 4 : 0, 0, 0}}}));
  file.json["nodes"][static_cast<std::size_t>(node)]["skin"] = file.add("skins", {{"joints", list}});
  EXPECT_EQ(art(file), middle("....WWWW"));
}

// Textures of different sizes: a metal above, a black dielectric below; the left half is matte, the right half is polished. The picture
// equals that of a metallic-roughness file with the converted textures.
TEST_F(GltfPicture, SpecularGlossinessIsConverted) {
  const auto write = [&](const char* name, int width, int height, const std::vector<glm::u8vec4>& texels) {
    Image<glm::u8vec4> image(width, height);
    std::ranges::copy(texels, image.data());
    write_png(directory / name, image);
  };
  const auto render = [&](const GltfJson& material) {
    GltfBuilder file;
    for (const char* name : {"diffuse.png", "specular.png", "base.png", "data.png"}) {
      file.add("images", {{"uri", name}});
      file.add("textures", {{"source", file.json["images"].size() - 1}, {"sampler", 0}});
    }
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    file.mesh_node(square(file, file.add("materials", material)));
    std::ofstream(directory / "a.gltf") << file.text();
    std::ofstream(directory / "scene.json") << R"({"version": 1, "cameras": {"c": {"type": "orthographic", "height": 4}},
      "lights": {"sun": {"direction": [0.2, 0.3, 1]}}, "environments": {"e": {"type": "studio", "size": 64}},
      "reflections": {"environment": "e"}, "objects": {"model": {"shape": "file", "file": "a.gltf"}}})";
    const Outcome o = run({"render", "scene.json", "--size", "32x32", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    const auto info = GltfJson::parse(run({"info", "a.gltf", "--json"}).out);
    EXPECT_EQ(info.at("textures"), 4);
    EXPECT_EQ(info.at("images").size(), 4u) << "images and textures that the reader adds are not in the file";
    EXPECT_EQ(info.at("warnings"), GltfJson::array());
    return picture("a.png");
  };
  write("diffuse.png", 1, 1, {{0, 0, 0, 255}});
  // sRGB 10 is a reflectance of 0.003, less than that of any dielectric.
  write("specular.png", 2, 2, {{250, 180, 60, 51}, {250, 180, 60, 204}, {10, 10, 10, 51}, {10, 10, 10, 204}});
  write("base.png", 2, 2, {{250, 180, 60, 255}, {250, 180, 60, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}});
  write("data.png", 2, 2, {{0, 204, 255, 255}, {0, 51, 255, 255}, {0, 204, 0, 255}, {0, 51, 0, 255}});
  const GltfJson specular_glossiness = {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}};
  const Image<glm::u8vec4> converted = render({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", specular_glossiness}}}});
  const Image<glm::u8vec4> expected =
      render({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 2}}}, {"metallicRoughnessTexture", {{"index", 3}}}}}});
  EXPECT_TRUE(converted == expected);
  EXPECT_NE(expected.at(4, 4), expected.at(28, 4)) << "roughness is visible";
  EXPECT_NE(expected.at(4, 4), expected.at(4, 28)) << "metalness is visible";
}

// Meshes without texture coordinates, lines and points have the color that the factors have without the textures.
TEST_F(GltfPicture, ConvertedFactorsApplyWithoutTextures) {
  write_png(directory / "map.png", Image<glm::u8vec4>(1, 1));
  const auto render = [&](int mode, bool textured) {
    GltfBuilder file;
    file.add("images", {{"uri", "map.png"}});
    file.add("textures", {{"source", 0}});
    GltfJson properties = {{"diffuseFactor", {0.1, 0.5, 0.02, 1}}, {"specularFactor", {0.3, 0.2, 0.1}}, {"glossinessFactor", 0.4}};
    if (textured) properties["diffuseTexture"] = properties["specularGlossinessTexture"] = {{"index", 0}};
    GltfJson mesh = square(file, file.add("materials", {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", properties}}}}));
    mesh["mode"] = mode;
    if (mode == 4) mesh["attributes"].erase("TEXCOORD_0");
    file.mesh_node(mesh);
    std::ofstream(directory / "a.gltf") << file.text();
    EXPECT_EQ(run({"render", "a.gltf", "--size", "64x36", "-o", "a.png"}).err, "");
    return picture("a.png");
  };
  for (const int mode : {0, 1, 4}) EXPECT_TRUE(render(mode, true) == render(mode, false)) << "mode " << mode;
  const glm::u8vec4 center = render(4, true).at(32, 18);
  EXPECT_GT(center.y, center.z + 40) << "the square is green";
}

// Files whose material has a diffuse and a specular-glossiness texture of different sizes.
class ExportOfConversions : public GltfPicture {
 protected:
  void SetUp() override {
    GltfPicture::SetUp();
    Image<glm::u8vec4> diffuse(4, 4), specular(2, 2);
    for (int i = 0; i < 16; ++i) diffuse.data()[i] = {16 * i, 200 - 8 * i, 90, 255};
    for (int i = 0; i < 4; ++i) specular.data()[i] = {80 * i, 60 * i, 50 * i, 60 * i};
    write_png(directory / "diffuse.png", diffuse);
    write_png(directory / "specular.png", specular);
    for (const char* name : {"diffuse.png", "specular.png"}) {
      file.add("images", {{"uri", name}});
      file.add("textures", {{"source", file.json["images"].size() - 1}});
    }
  }
  int material(double glossiness) {
    GltfJson textured = maps;
    textured["glossinessFactor"] = glossiness;
    return file.add("materials", {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", textured}}}});
  }
  Outcome export_to(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::ofstream(directory / "a.gltf") << file.text();
    std::vector<std::string> arguments{"export", "a.gltf", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  GltfJson images_of(const std::string& name) const { return GltfJson::parse(run({"info", name, "--json"}).out).at("images"); }
  // Exports the file to b.glb and checks that it shows the same picture.
  void expect_same_picture() const {
    const Outcome exported = export_to("b.glb");
    EXPECT_EQ(exported.exit_code, 0);
    EXPECT_EQ(exported.err, "");
    for (const char* name : {"a.gltf", "b.glb"})
      EXPECT_EQ(run({"render", name, "--size", "64x36", "-o", std::string(1, name[0]) + ".png"}).err, "");
    EXPECT_TRUE(picture("a.png") == picture("b.png"));
  }

  GltfBuilder file;
  GltfJson maps = {{"diffuseTexture", {{"index", 0}}}, {"specularGlossinessTexture", {{"index", 1}}}};
};

// An exported file contains the converted textures, not their sources, and shows the same picture.
TEST_F(ExportOfConversions, ContainsTheResults) {
  file.mesh_node(square(file, material(1.0)));
  expect_same_picture();
  EXPECT_EQ(images_of("b.glb").size(), 2u);
  const Outcome obj = export_to("b.obj");
  EXPECT_EQ(obj.exit_code, 0);
  EXPECT_EQ(obj.err, "") << "the sources are not reported as omitted";
}

// Textures with different coordinates: only the roughness is converted, and both sources are used.
TEST_F(ExportOfConversions, OmitsResultsThatNoMaterialUses) {
  maps["specularGlossinessTexture"]["texCoord"] = 1;
  GltfJson mesh = square(file, material(1.0));
  mesh["attributes"]["TEXCOORD_1"] = mesh["attributes"]["TEXCOORD_0"];
  file.mesh_node(mesh);
  EXPECT_EQ(export_to("b.glb").exit_code, 0);
  const GltfJson images = images_of("b.glb");
  EXPECT_EQ(images.size(), 3u);
  for (const GltfJson& image : images) EXPECT_TRUE(image.at("used").get<bool>()) << image;
}

// Meshes that cannot be textured have a copy of the material, with the factors of the conversion.
TEST_F(ExportOfConversions, KeepsTheFactorsOfMeshesWithoutTextures) {
  maps["diffuseFactor"] = {0.1, 0.5, 0.02, 1};
  const int shared = material(0.5);
  GltfJson mesh = square(file, shared);
  file.mesh_node(mesh);
  mesh["attributes"].erase("TEXCOORD_0");
  file.json["nodes"][static_cast<std::size_t>(file.mesh_node(mesh))]["translation"] = {4, 0, 0};
  expect_same_picture();
  EXPECT_EQ(GltfJson::parse(run({"info", "b.glb", "--json"}).out).at("materials").size(), 2u);
}

TEST_F(ExportOfConversions, ReportsEachUnreadableSourceOnce) {
  file.add("images", {{"uri", "data:image/png;base64," + GltfBuilder::base64(std::as_bytes(std::span("no image", 8)))}});
  file.json["textures"][0]["source"] = 2;
  file.mesh_node(square(file, material(1.0)));
  const Outcome o = export_to("b.glb");
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(lines_of(o.err), 1) << o.err;
  EXPECT_NE(o.err.find("a.gltf: images[2]: "), std::string::npos) << o.err;
}

// Conversions that share a source report it once.
TEST_F(ExportOfConversions, RenderReportsEachUnreadableSourceOnce) {
  for (int i = 0; i < 2; ++i) {
    file.add("images", {{"uri", "data:image/png;base64," + GltfBuilder::base64(std::as_bytes(std::span("no image", 8)))}});
    file.json["textures"][static_cast<std::size_t>(i)]["source"] = 2 + i;
  }
  file.mesh_node(square(file, material(1.0)));
  maps.erase("specularGlossinessTexture");
  file.mesh_node(square(file, material(1.0)));
  std::ofstream(directory / "a.gltf") << file.text();
  const Outcome o = run({"render", "a.gltf", "--size", "64x36"});
  for (const std::string image : {"images[2]", "images[3]"}) {
    EXPECT_NE(o.err.find(image), std::string::npos) << o.err;
    EXPECT_EQ(o.err.find(image), o.err.rfind(image)) << o.err;
  }
}

// Each conversion counts towards the memory limit with the size of its results, 2 MiB here. Materials that no mesh uses are not converted.
TEST_F(ExportOfConversions, AreLimitedByMemory) {
  write_png(directory / "diffuse.png", Image<glm::u8vec4>(512, 512));
  for (int i = 0; i < 110; ++i) material(i / 110.0);
  file.mesh_node(square(file, 0));
  EXPECT_EQ(export_to("b.glb", {"--max-memory", "200M"}).err, "");
  EXPECT_EQ(images_of("b.glb").size(), 2u);
  for (int i = 1; i < 110; ++i) file.mesh_node(square(file, i));
  ::setenv("MALLOC_MMAP_THRESHOLD_", "131072", 1);  // without fragmentation, the resident memory stays small
  const Outcome o = export_to("b.glb", {"--max-memory", "200M"});
  ::unsetenv("MALLOC_MMAP_THRESHOLD_");
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_EQ(lines_of(o.err), 1) << o.err;
  EXPECT_NE(o.err.find("200 MiB (--max-memory)"), std::string::npos) << o.err;
}

// Renders a file with the default light and environment, and returns the mean color of the 8x8 pixels in the middle.
class SheenPicture : public GltfPicture {
 protected:
  glm::dvec3 color(const std::string& file) const {
    const Outcome o = run({"render", file, "--size", "32x32", "--no-floor", "--yaw", "60", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    const Image<glm::u8vec4> image = read_image(directory / "a.png");
    glm::dvec3 sum(0.0);
    for (int y = 12; y < 20; ++y) {
      for (int x = 12; x < 20; ++x) sum += glm::dvec3(image.at(x, y)) / 64.0;
    }
    return sum;
  }
  void write_texel(const glm::u8vec4& code) const {
    Image<glm::u8vec4> image(1, 1);
    image.at(0, 0) = code;
    write_png(directory / "texel.png", image);
  }
  // The color of a square with this sheen, whose textures have index 0.
  glm::dvec3 color_with(const GltfJson& sheen) const {
    GltfBuilder file;
    file.add("images", {{"uri", "texel.png"}});
    file.add("textures", {{"source", 0}});
    const int material = file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.1, 0.1, 1}}, {"metallicFactor", 0}}},
                                                {"doubleSided", true},
                                                {"extensions", {{"KHR_materials_sheen", sheen}}}});
    file.mesh_node(square(file, material));
    std::ofstream(directory / "a.gltf") << file.text();
    return color("a.gltf");
  }
};

TEST_F(SheenPicture, TexturesMultiplyTheFactors) {
  write_texel({255, 0, 188, 128});
  const GltfJson white = {1, 1, 1}, texture = {{"index", 0}};
  const auto expect_same = [&](const GltfJson& mapped, const GltfJson& factors) {
    const glm::dvec3 a = color_with(mapped), b = color_with(factors);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1.0) << mapped.dump();  // one code, because factors are not rounded to texels
    return b;
  };
  const glm::dvec3 tinted = expect_same({{"sheenColorFactor", white}, {"sheenColorTexture", texture}, {"sheenRoughnessFactor", 0.8}},
                                        {{"sheenColorFactor", {1, 0, 0.503}}, {"sheenRoughnessFactor", 0.8}});
  EXPECT_GT(tinted.x, tinted.y + 10.0);
  const glm::dvec3 rough = expect_same({{"sheenColorFactor", white}, {"sheenRoughnessFactor", 1}, {"sheenRoughnessTexture", texture}},
                                       {{"sheenColorFactor", white}, {"sheenRoughnessFactor", 0.502}});
  EXPECT_GT(glm::length(rough - color_with({{"sheenColorFactor", white}, {"sheenRoughnessFactor", 1}})), 5.0);
}

// In MTL, Ps is the strength of white sheen, and map_Ps a channel that multiplies it.
TEST_F(SheenPicture, MapOfMtlMultipliesTheFactor) {
  write_texel({0, 51, 255, 255});
  const auto color_of = [&](const std::string& statements) {
    std::ofstream(directory / "a.obj") << "mtllib a.mtl\nusemtl m\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\n"
                                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    std::ofstream(directory / "a.mtl") << "newmtl m\nKd 0.3 0.3 0.3\nPr 0.9\n" << statements;
    return color("a.obj");
  };
  const glm::dvec3 none = color_of(""), weak = color_of("Ps 0.2\n"), mapped = color_of("Ps 1\nmap_Ps -imfchan g texel.png\n"),
                   full = color_of("Ps 1\n");
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(mapped[k], weak[k], 1.0);
  EXPECT_GT(weak.x, none.x + 2.0);
  EXPECT_GT(full.x, weak.x + 5.0);
}

}  // namespace
}  // namespace halfspace
