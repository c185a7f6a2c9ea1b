// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "halfspace/core/srgb.h"
#include "halfspace/model/geometry/normals.h"
#include "model/ply_text.h"
#include "model/test_meshes.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/folder_test.h"

namespace halfspace {
namespace {

const std::string kXyz = "property double x\nproperty double y\nproperty double z\n";
const std::string kTriangleData = "0 0 0\n1 0 0\n0 1 0\n";

std::string vertices(int count) { return fmt::format("element vertex {}\n{}", count, kXyz); }
std::string ascii(const std::string& elements, const std::string& data) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + data;
}

std::string cube_file(const std::string& encoding, double offset, double scale) {
  PlyData data{encoding, {}};
  const ModelMesh mesh = cube();
  for (const glm::vec3& p : mesh.positions) {
    for (int i = 0; i < 3; ++i) data.add(static_cast<double>(p[i]) * scale + offset);
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    data.add_list<uint32_t>({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]});
  return data.with_header(vertices(8) + "element face 12\nproperty list uchar uint vertex_indices\n");
}

TEST(Ply, EncodingsGiveIdenticalModels) {
  const ModelMesh expected = [] {
    ModelMesh mesh = cube();
    add_smooth_normals(mesh, 30.0f);
    return mesh;
  }();
  for (const char* const encoding : kPlyEncodings) {
    const Model model = ply_model(cube_file(encoding, 0.0, 1.0));
    EXPECT_EQ(model.format, "PLY");
    EXPECT_EQ(model.up, UpAxis::y);
    EXPECT_TRUE(model.warnings.empty());
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].positions, expected.positions) << encoding;
    EXPECT_EQ(model.meshes[0].normals, expected.normals) << encoding;
    EXPECT_EQ(model.meshes[0].indices, expected.indices) << encoding;
    EXPECT_EQ(model.nodes.at(0).meshes, std::vector<int>{0});
    EXPECT_TRUE(model.materials.at(0).double_sided);
    EXPECT_EQ(model.materials[0].base_color, glm::vec4(0.8f, 0.8f, 0.8f, 1.0f));
  }
}

TEST(Ply, DistantAndTinyCubesKeepTheirShape) {
  for (const char* const encoding : kPlyEncodings) {
    const ModelMesh distant = ply_model(cube_file(encoding, 5e6, 1.0)).meshes[0];
    EXPECT_EQ(distant.origin, glm::dvec3(5e6));
    for (const double scale : {0x1p-20, 0x1p20}) {
      const ModelMesh scaled = ply_model(cube_file(encoding, 0.0, scale)).meshes[0];
      ASSERT_EQ(scaled.positions.size(), distant.positions.size());
      EXPECT_EQ(scaled.normals, distant.normals);
      for (std::size_t i = 0; i < scaled.positions.size(); ++i)
        EXPECT_EQ(scaled.positions[i], distant.positions[i] * static_cast<float>(scale));
    }
  }
}

TEST(Ply, ReadsAllTypesAndSkipsUnknownData) {
  for (const char* const encoding : kPlyEncodings) {
    PlyData data{encoding, {}};
    data.add_list<int16_t>({7, 8}).add(int8_t{-1}).add(3.5);  // an unknown element
    data.add_list<int16_t>({}).add(int8_t{-1}).add(3.5);
    for (const int face : {0}) data.add(uint16_t(face)).add(int32_t{4}).add(int16_t{0}).add(int16_t{1}).add(int16_t{2}).add(int16_t{3});
    const int8_t square[4][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    for (const auto& corner : square) data.add(uint32_t{9}).add(corner[0]).add(static_cast<int16_t>(corner[1])).add(0.5f);
    const std::string header =
        "comment any order\nobj_info none\nelement other 2\nproperty list uint8 int16 a\nproperty int8 b\nproperty float64 c\n"
        "element face 1\nproperty uint16 flags\nproperty list int32 short vertex_index\n"
        "element vertex 4\nproperty uint id\nproperty char x\nproperty int16 y\nproperty float32 z\n";
    const ModelMesh mesh = ply_model(data.with_header(header)).meshes[0];
    EXPECT_EQ(mesh.origin, glm::dvec3(1.0, 1.0, 0.5)) << encoding;
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1.0f, 1.0f, 0.0f));
    for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  }
}

TEST(Ply, AcceptsAllLineEndings) {
  std::string text = ascii(vertices(3), kTriangleData);
  for (const std::string end : {"\r\n", "\r"}) {
    std::string changed;
    for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(ply_model(changed).meshes[0].positions.size(), 3u);
  }
}

TEST(Ply, IgnoresTheCaseOfPropertyNames) {
  const Model model =
      ply_model(ascii("element vertex 1\nproperty float X\nproperty float Y\nproperty float Z\nproperty uchar Red\n"
                      "property uchar Green\nproperty uchar Blue\n",
                      "1 2 3 255 0 0\n"));
  EXPECT_EQ(model.meshes[0].origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(model.meshes[0].colors.at(0), glm::vec4(1, 0, 0, 1));
}

TEST(Ply, ConvertsColorsAndTextureCoordinates) {
  const std::string header = "element vertex 3\n" + kXyz +
                             "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                             "property float s\nproperty float t\nproperty float nx\nproperty float ny\nproperty float nz\n";
  const Model model = ply_model(ascii(header, "0 0 0 255 128 0 255 0.25 0.75 0 0 2\n1 0 0 0 0 0 51 0 0 0 0 1\n0 1 0 0 0 0 0 0 0 0 0 1\n"));
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.colors[0], glm::vec4(1.0f, kSrgbToLinear[128], 0.0f, 1.0f));
  EXPECT_EQ(mesh.colors[1].w, 0.2f);
  EXPECT_EQ(mesh.uvs[0][0], glm::vec2(0.25f, 0.25f));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(1.0f));
  EXPECT_EQ(model.materials[0].alpha_mode, AlphaMode::blend);
}

TEST(Ply, IgnoresTheOpacityIfAllColorsAreTransparent) {
  const std::string header = vertices(1) + "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  const Model model = ply_model(ascii(header, "0 0 0 255 255 255 0"));
  EXPECT_EQ(model.meshes[0].colors[0], glm::vec4(1.0f));
  EXPECT_EQ(model.materials[0].alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(Ply, ReadsFaceColorsAndTextureCoordinatesOfCorners) {
  const std::string header = vertices(4) +
                             "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                             "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const ModelMesh mesh = ply_model(ascii(header, kTriangleData + "1 1 0\n3 0 1 2 6 0 0 1 0 0 1 255 0 0\n3 1 3 2 0 0 255 0\n")).meshes[0];
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.uvs[0][1], glm::vec2(1.0f, 1.0f));
  EXPECT_EQ(mesh.uvs[0][2], glm::vec2(0.0f, 0.0f));
  EXPECT_EQ(mesh.colors[2], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(mesh.colors[3], glm::vec4(0, 1, 0, 1));
}

TEST(Ply, ReadsTriangleStrips) {
  const std::string header = vertices(5) + "element tristrips 1\nproperty list int int vertex_indices\n";
  const ModelMesh mesh = ply_model(ascii(header, "0 0 0 0 1 0 1 0 0 1 1 0 2 0 0\n11 0 2 1 3 -1 2 4 3 3 -1 0\n")).meshes[0];
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 2, 1, 1, 2, 3, 2, 4, 3}));
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(Ply, WithoutFacesGivesPointsOrLines) {
  const ModelMesh points = ply_model(ascii(vertices(3), "0 0 0 nan 0 0 1 1 1")).meshes[0];
  EXPECT_EQ(points.topology, MeshTopology::points);
  EXPECT_EQ(points.positions.size(), 2u);
  EXPECT_TRUE(points.indices.empty());
  EXPECT_TRUE(ply_model(ascii(vertices(3), kTriangleData)).meshes[0].indices.empty());
  const std::string edges = vertices(3) + "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
  const ModelMesh lines = ply_model(ascii(edges, kTriangleData + "0 1 1 2")).meshes[0];
  EXPECT_EQ(lines.topology, MeshTopology::lines);
  EXPECT_EQ(lines.indices, (std::vector<uint32_t>{0, 1, 1, 2}));
}

TEST(Ply, OmitsFacesThatCannotBeDrawn) {
  const std::string header = vertices(4) + "element face 3\nproperty list uchar int vertex_indices\n";
  const Model model = ply_model(ascii(header, kTriangleData + "inf 0 1e999\n3 0 1 2\n3 0 1 3\n2 0 1\n"));
  EXPECT_EQ(model.meshes[0].indices.size(), 3u);
  EXPECT_EQ(model.meshes[0].positions.size(), 3u);
  EXPECT_EQ(model.warnings.size(), 2u);
}

// 204, 102 and 51 are 0.8, 0.4 and 0.2 of 255, and 52428, 26214 and 13107 of 65535.
TEST(Ply, ReadsTheSameColorFromAllTypes) {
  const auto color = [](const std::string& type, const std::string& values) {
    std::string header = vertices(2);
    for (const char* name : {"red", "green", "blue", "alpha"}) header += "property " + type + " " + name + "\n";
    return ply_model(ascii(header, "0 0 0 0 0 0 0 1 1 1 " + values)).meshes[0].colors.at(1);
  };
  const glm::vec4 expected(kSrgbToLinear[204], kSrgbToLinear[102], kSrgbToLinear[51], 0.2f);
  for (const char* type : {"uchar", "short", "ushort", "int", "uint", "float", "double"})
    EXPECT_EQ(color(type, "204 102 51 51"), expected) << type;
  for (const char* type : {"ushort", "int", "uint", "float", "double"}) EXPECT_EQ(color(type, "52428 26214 13107 13107"), expected) << type;
  for (const char* type : {"float", "double"}) {
    EXPECT_EQ(color(type, "0.8 0.4 0.2 0.2"), expected) << type;
    EXPECT_EQ(color(type, "204 102 51 0.2"), expected) << "opacity has its own range";
    EXPECT_EQ(color(type, "1.0001 -1 0 1"), glm::vec4(1, 0, 0, 1)) << type;
  }
  EXPECT_EQ(color("char", "-52 102 51 51"), expected) << "a byte that is declared as signed";
}

TEST(Ply, OneValueAboveOneDecidesTheRangeOfAllColors) {
  const std::string faces =
      "element face 2\nproperty list uchar int vertex_indices\nproperty float red\nproperty float green\nproperty float blue\n";
  const ModelMesh mesh = ply_model(ascii(vertices(3) + faces, kTriangleData + "3 0 1 2 1 0 0\n3 0 1 2 0 255 0\n")).meshes[0];
  EXPECT_EQ(mesh.colors.at(0), glm::vec4(kSrgbToLinear[1], 0, 0, 1));
  EXPECT_EQ(mesh.colors.at(3), glm::vec4(0, 1, 0, 1));
}

TEST(Ply, ReplacesAttributesThatAreNotFinite) {
  const std::string header = vertices(3) +
                             "property float red\nproperty float green\nproperty float blue\nproperty float s\nproperty float t\n"
                             "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int "
                             "vertex_indices\n";
  const Model model = ply_model(
      ascii(header, "0 0 0 1 0 0 1.#INF 0 1 0 0\n1 0 0 nan 0 0 1 1 -1.#IND00 0 0\n0 1 0 1 0 0 0 -nan(ind) 1.#QNAN 0 1\n3 0 1 2\n"));
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec4>{{1, 0, 0, 1}, {1, 1, 1, 1}, {1, 0, 0, 1}}));
  EXPECT_EQ(mesh.uvs[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 0}}));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{1, 0, 0}, {0, 0, 1}, {0, 0, 1}})) << "computed from the face";
  EXPECT_FALSE(mesh.computed_normals);
  EXPECT_EQ(model.warnings.size(), 3u);
}

TEST(Ply, BinaryValuesThatAreNotFiniteAreReplaced) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const char* const encoding : kPlyEncodings) {
    PlyData data{encoding, {}};
    for (const float x : {0.0f, 0.0f, 0.0f, nan, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 5.0f, nan, 5.0f, 0.0f}) data.add(x);
    data.add_list<uint32_t>({0, 1, 2}).add_list<uint32_t>({0, 1, 3});
    const Model model =
        ply_model(data.with_header("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                                   "property float nx\nelement face 2\nproperty list uchar uint vertex_indices\n"));
    EXPECT_EQ(model.meshes[0].positions.size(), 3u) << encoding;
    EXPECT_EQ(model.meshes[0].origin, glm::dvec3(0.5, 0.5, 0.0));
    EXPECT_EQ(model.warnings.size(), 1u);
  }
}

TEST(Ply, IgnoresVerticesThatNoFaceUses) {
  const std::string header = "element vertex 6\n" + kXyz + "property float red\nproperty float green\nproperty float blue\n" +
                             "element face 1\nproperty list uchar int vertex_indices\n";
  const Model model = ply_model(ascii(header,
                                      "1e30 0 0 9 9 9\n0 0 0 1 0 0\n1000 0 0 255 0 0\n1 0 0 1 0 0\nnan 0 0 nan 0 0\n0 1 0 1 0 0\n"
                                      "3 1 3 5\n"));
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.origin, glm::dvec3(0.5, 0.5, 0.0));
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(mesh.colors, std::vector<glm::vec4>(3, {1, 0, 0, 1})) << "unused colors do not decide the range";
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Ply, LinesUseTheirVertices) {
  const std::string header = vertices(4) + "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
  const ModelMesh mesh = ply_model(ascii(header, "9 9 9 0 0 0 1 0 0 nan 0 0\n1 2 2 3\n")).meshes[0];
  EXPECT_EQ(mesh.positions.size(), 2u);
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1}));
}

double area_of(const ModelMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]), c(mesh.positions[mesh.indices[t + 2]]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

// A concave pentagon of area 2.5, whose corners are repeated by index or by position.
TEST(Ply, RepeatedCornersOfAFaceAreOneCorner) {
  const std::string header = vertices(6) + "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string corners = "0 0 0 2 0 0 2 2 0 1 0.5 0 0 2 0 2 0 0\n";
  for (const char* face : {"5 0 1 2 3 4", "9 0 0 1 1 2 3 3 4 4", "6 0 1 2 3 4 0", "6 0 1 5 2 3 4", "8 4 0 0 1 5 2 3 4"}) {
    const Model model = ply_model(ascii(header, corners + face));
    EXPECT_EQ(area_of(model.meshes[0]), 2.5) << face;
    EXPECT_EQ(model.meshes[0].positions.size(), 5u) << face;
    EXPECT_TRUE(model.warnings.empty()) << face;
  }
  const std::string two = vertices(4) + "element face 2\nproperty list uchar int vertex_indices\n";
  const Model model = ply_model(ascii(two, kTriangleData + "9 9 9\n3 0 1 2\n3 3 3 1\n"));
  EXPECT_EQ(model.meshes[0].positions.size(), 3u);
  EXPECT_EQ(model.warnings.size(), 1u);
}

class PlyTexture : public FolderTest {};

TEST_F(PlyTexture, IsFoundByItsComment) {
  put("wood.png", "");
  const std::string header = "comment TextureFile wood.png\n" + vertices(3) + "property float u\nproperty float v\n";
  const std::string text = ascii(header, "0 0 0 0 0 1 0 0 1 0 0 1 0 0 1");
  const Model model = read_ply(directory / "a.ply", std::as_bytes(std::span(text)), {});
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].file.filename(), "wood.png");
  EXPECT_EQ(model.materials[0].base_color_map.texture, 0);
}

TEST(Ply, RejectsInvalidHeaders) {
  const auto rejects = [](const std::string& text, const std::string& place, const std::string& keyword) {
    EXPECT_TRUE(reports(input_error([&] { ply_model(text); }), "a.ply: " + place, {keyword, "expected"}));
  };
  rejects("ply\n", "line 2", "end_header");
  rejects("ply\nformat ascii 1.0\nelement vertex 1", "line 3", "end_header");
  rejects("ply\nend_header\n", "line 2", "format");
  rejects("ply\nformat text 1.0\n", "line 2", "'text'");
  rejects("ply\nformat ascii 2.0\n", "line 2", "'2.0'");
  rejects("ply\nproperty int x\n", "line 2", "element");
  rejects("ply\nelement vertex -1\n", "line 2", "count");
  rejects("ply\nelement vertex 99999999999999999999\n", "line 2", "count");
  rejects("ply\nelement vertex 1\nproperty half x\n", "line 3", "'half'");
  rejects("ply\nelement vertex 1\nproperty list float int x\n", "line 3", "integer");
  rejects("ply\nelement vertex 1\nproperty int\n", "line 3", "name");
  rejects("ply\nvertices 1\n", "line 2", "element");
  rejects("ply\nformat ascii 1.0\n" + std::string(2 << 20, ' '), "line 3", "end_header");
  rejects(ascii(vertices(2000000000), "0 0 0"), "element 'vertex'", "2000000000");
  rejects(ascii("element vertex 0\n" + kXyz, ""), "", "no vertices");
  rejects(ascii("element vertex 1\nproperty int x\n", "1"), "element 'vertex'", "x, y and z");
  rejects(ascii(vertices(1), "nan 0 0"), "", "finite");
  rejects(ascii(vertices(1), "1e30 0 0"), "", "1e+30");
}

TEST(Ply, RejectsInvalidData) {
  const std::string faces = vertices(3) + "element face 2\nproperty list char int vertex_indices\n";
  const auto rejects = [](const std::string& text, const std::string& place, const std::string& keyword) {
    EXPECT_TRUE(reports(input_error([&] { ply_model(text); }), "a.ply: element " + place, {keyword, "expected"}));
  };
  rejects(ascii(vertices(3), "0 0 0 1 1 1 2 2     "), "'vertex', row 2", "ends");
  rejects(ascii(vertices(3), "0 0 0 1 one 1 2 2 2"), "'vertex', row 1", "'one'");
  rejects(ascii(faces, kTriangleData + "3 0 1 2 3 0 1 3"), "'face', row 1", "vertex index 3");
  rejects(ascii(faces, kTriangleData + "3 0 1 -1 3 0 1 2"), "'face', row 0", "vertex index -1");
  rejects(ascii(faces, kTriangleData + "3 0 1 0.5 3 0 1 2"), "'face', row 0", "vertex index 0.5");
  rejects(ascii(faces, kTriangleData + "3 0 1 nan 3 0 1 2"), "'face', row 0", "vertex index nan");
  rejects(ascii(faces, kTriangleData + "-3 0 1 2 3 0 1 2"), "'face', row 0", "length -3");
  rejects(ascii(faces, kTriangleData + "100 0 1 2 3 0 1 2"), "'face', row 0", "length 100");
  for (const char* const encoding : {"binary_little_endian", "binary_big_endian"}) {
    const std::string whole = cube_file(encoding, 0.0, 1.0);
    for (const std::size_t missing : {1u, 12u, 13u, 100u}) rejects(whole.substr(0, whole.size() - missing), "'face', row ", "");
  }
}

// Rows of floats and rows of three indices are read separately.
TEST(Ply, ReadsTrianglesAndPolygonsInAnyOrder) {
  const auto file = [](const std::string& encoding, const std::vector<std::vector<int32_t>>& faces) {
    PlyData data{encoding, {}};
    for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.25f}) data.add(x);
    for (const std::vector<int32_t>& face : faces) data.add_list(face);
    return data.with_header("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
                            fmt::format("element face {}\nproperty list uchar int vertex_indices\n", faces.size()));
  };
  for (const char* const encoding : kPlyEncodings) {
    const Model model = ply_model(file(encoding, {{0, 1, 2}, {2, 3, 0}, {0, 1, 2, 3}, {}, {1, 2, 3}}));
    EXPECT_EQ(model.meshes.at(0).indices.size(), 15u) << encoding;
    EXPECT_EQ(model.warnings.size(), 1u) << encoding;  // the empty face
    const std::string points = file(encoding, {});
    EXPECT_TRUE(
        reports(input_error([&] { ply_model(points.substr(0, points.size() - 5)); }), "a.ply: element 'vertex'", {"4 rows", "at most 3"}));
    for (const int32_t index : {-1, 4}) {
      EXPECT_TRUE(reports(input_error([&] {
                            ply_model(file(encoding, {{0, 1, 2}, {0, 1, index}}));
                          }),
                          "a.ply: element 'face', row 1", {fmt::format("vertex index {}", index), "0 to 3"}))
          << encoding;
    }
  }
}

TEST(Ply, RejectsFilesThatNeedTooMuchMemory) {
  ReadModelOptions options;
  options.max_memory = 1000;
  EXPECT_TRUE(reports(input_error([&] { ply_model(cube_file("ascii", 0, 1), options); }), "a.ply: ", {"memory"}));
}

}  // namespace
}  // namespace halfspace
