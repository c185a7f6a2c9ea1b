// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "halfspace/core/srgb.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/stl/read_stl.h"
#include "model/test_meshes.h"
#include "support/errors.h"

namespace halfspace {
namespace {

Model stl_model(const std::string& contents) { return read_stl("a.stl", std::as_bytes(std::span(contents)), {}); }

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_cube(const std::string& name, uint16_t attribute) {
  const ModelMesh mesh = cube();
  std::string bytes = name + std::string(80 - name.size(), '\0');
  append(bytes, static_cast<uint32_t>(mesh.indices.size() / 3));
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    append(bytes, glm::vec3(7.0f, 0.0f, 0.0f));  // a wrong normal
    for (std::size_t k = 0; k < 3; ++k) append(bytes, mesh.positions[mesh.indices[t + k]]);
    append(bytes, attribute);
  }
  return bytes;
}

std::string text_facet(const ModelMesh& mesh, std::size_t t, double offset) {
  std::string text = "facet normal 0 0 0\nouter loop\n";
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 p = glm::dvec3(mesh.positions[mesh.indices[t + k]]) + offset;
    text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y * 1e-3) + "E+3 +" + std::to_string(p.z + 10.0) + "\n";
  }
  return text + "endloop\nendfacet\n";
}

std::string text_cube(double offset) {
  const ModelMesh mesh = cube();
  std::string text = "solid the first facet\n";
  for (std::size_t t = 0; t < 18; t += 3) text += text_facet(mesh, t, offset);
  text += "endsolid the first facet\nsolid\n";
  for (std::size_t t = 18; t < 36; t += 3) text += text_facet(mesh, t, offset);
  return text + "endsolid\n";
}

TEST(Stl, BinaryAndTextGiveTheSameCube) {
  ModelMesh expected = cube();
  add_smooth_normals(expected, 30.0f);
  for (const std::string& file : {binary_cube("", 0), binary_cube("solid cube\nfacet", 0), text_cube(0.0), text_cube(5e6)}) {
    const Model model = stl_model(file);
    EXPECT_EQ(model.format, "STL");
    EXPECT_EQ(model.up, UpAxis::z);
    const ModelMesh& mesh = model.meshes.at(0);
    ASSERT_EQ(mesh.indices.size(), expected.indices.size());
    EXPECT_EQ(mesh.positions.size(), 24u);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      EXPECT_EQ(mesh.positions[mesh.indices[i]], expected.positions[expected.indices[i]]);
      EXPECT_EQ(mesh.normals[mesh.indices[i]], expected.normals[expected.indices[i]]);
    }
  }
}

TEST(Stl, AcceptsUpperCaseAndBlanks) {
  std::string text = text_cube(0.0);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  std::string spaced = "  \r\n";
  for (const char c : text) spaced += c == '\n' ? "\r\n\t " : std::string(1, c);
  EXPECT_EQ(stl_model(spaced).meshes[0].indices.size(), 36u);
}

// Without line breaks, the name of a solid ends at the next keywords.
TEST(Stl, ReadsTextFilesOfOneLine) {
  std::string text = text_cube(0.0);
  std::ranges::replace(text, '\n', ' ');
  EXPECT_EQ(stl_model(text).meshes[0].indices.size(), 36u);
}

TEST(Stl, ReadsColorsOfBinaryFiles) {
  const ModelMesh mesh = stl_model(binary_cube("", 0x8000 | 31 << 10 | 16 << 5)).meshes[0];
  ASSERT_EQ(mesh.colors.size(), 36u);
  EXPECT_EQ(mesh.colors[35].x, 1.0f);
  EXPECT_NEAR(mesh.colors[35].y, kSrgbToLinear[132], 2e-3);  // 16/31 corresponds to the 8-bit value 131.6
  EXPECT_EQ(mesh.colors[35].z, 0.0f);
  EXPECT_TRUE(stl_model(binary_cube("", 0x7fff)).meshes[0].colors.empty());
}

// Materialise Magics: red is in the low bits, and bit 15 selects the color in the header.
TEST(Stl, ReadsColorsOfMagics) {
  const std::string header("COLOR=\xff\x80\x00\xff,MATERIAL=", 20);
  const auto color = [&](uint16_t attribute) { return stl_model(binary_cube(header, attribute)).meshes[0].colors.at(0); };
  EXPECT_EQ(color(31), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(color(31 << 5), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(color(31 << 10), glm::vec4(0, 0, 1, 1));
  const glm::vec4 orange(1.0f, kSrgbToLinear[128], 0.0f, 1.0f);
  EXPECT_EQ(color(0x8000), orange);
  EXPECT_EQ(color(0xffff), orange);
  EXPECT_EQ(color(0), orange) << "no attributes";
  const std::string glass("solid COLOR=\xff\xff\xff\x33", 16);
  const Model model = stl_model(binary_cube(glass, 0x8000));
  EXPECT_EQ(model.meshes[0].colors.at(0), glm::vec4(1, 1, 1, 0.2f));
  EXPECT_EQ(model.materials[0].alpha_mode, AlphaMode::blend);
}

// Inserts `length(t)` bytes after triangle t and stores this number as its attribute.
template <class F>
std::string with_payload(const std::string& plain, F length) {
  std::string bytes = plain.substr(0, 84);
  for (std::size_t t = 0; t < 12; ++t) {
    bytes += plain.substr(84 + 50 * t, 48);
    append(bytes, static_cast<uint16_t>(length(t)));
    bytes += std::string(length(t), static_cast<char>('a' + t));
  }
  return bytes;
}

double volume_of(const ModelMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]), c(mesh.positions[mesh.indices[t + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return volume;
}

// A cube whose facets have the right normals.
std::string unit_normal_cube(const std::string& name, uint16_t attribute) {
  std::string bytes = binary_cube(name, attribute);
  for (std::size_t t = 0; t < 12; ++t) bytes.replace(84 + 50 * t, 12, std::string(12, '\0'));
  return bytes;
}

TEST(Stl, SkipsAttributeDataThatFollowsATriangle) {
  const double volume = volume_of(stl_model(binary_cube("", 0)).meshes[0]);
  const std::string plain = unit_normal_cube("", 0);
  const auto varying = [](std::size_t t) { return t * 7 % 5; };
  for (const std::string& file : {with_payload(plain, varying), with_payload(plain, [](std::size_t) { return std::size_t{50}; })}) {
    const Model model = stl_model(file);
    EXPECT_EQ(model.meshes[0].indices.size(), 36u);
    EXPECT_EQ(volume_of(model.meshes[0]), volume);
    EXPECT_EQ(model.warnings.size(), 1u);
  }
  const Model model = stl_model(with_payload(plain, varying) + "end");
  EXPECT_EQ(volume_of(model.meshes[0]), volume);
  EXPECT_EQ(model.warnings.size(), 2u) << "the data, and the bytes at the end";
}

TEST(Stl, ReadsFilesWithAWrongNumberOfTriangles) {
  const std::string good = unit_normal_cube("", 0x8000 | 31);
  for (const uint32_t declared : {0u, 13u, 1000000u, 0xffffffffu}) {
    std::string bytes = good;
    bytes.replace(80, 4, reinterpret_cast<const char*>(&declared), 4);
    const Model model = stl_model(bytes);
    EXPECT_EQ(model.meshes[0].indices.size(), 36u) << declared;
    ASSERT_EQ(model.warnings.size(), 1u) << declared;
    EXPECT_NE(model.warnings[0].find("has 12"), std::string::npos);
  }
  EXPECT_EQ(stl_model(good.substr(0, 600)).meshes[0].indices.size(), 30u);
  EXPECT_EQ(stl_model(good.substr(0, 600)).warnings.size(), 2u) << "the number, and the part of a triangle";
}

TEST(Stl, ReportsBytesThatAreLeftOver) {
  for (const char* name : {"", "solid", "solid cube facet normal", "solid a\nfacet normal 0 0 1"}) {
    const Model model = stl_model(unit_normal_cube(name, 0x8000 | 31) + "abc");
    EXPECT_EQ(model.meshes[0].indices.size(), 36u) << name;
    EXPECT_FALSE(model.meshes[0].colors.empty());
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find("3 bytes"), std::string::npos) << model.warnings[0];
  }
}

TEST(Stl, ReadsVariantsOfText) {
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const auto triangles = [](const std::string& text) { return stl_model(text).meshes[0].indices.size() / 3; };
  const std::string end = "endloop\nendfacet\n";
  EXPECT_EQ(triangles("solid\n" + facet + end + facet + end), 2u) << "without endsolid";
  EXPECT_EQ(triangles("solid\n" + facet + "endfacet\n" + facet + "endloop\nendsolid"), 2u) << "without endloop or endfacet";
  EXPECT_EQ(triangles(facet + end), 1u) << "without solid";
  EXPECT_EQ(triangles("solid\n" + facet + "vertex -1 1 0\nvertex -1 0 0\n" + end), 3u) << "a pentagon";
  EXPECT_EQ(triangles("solid a\n" + facet + end + "endsolid\nSOLID b\n" + facet + end + "endsolid\n"), 2u);
  const Model cut = stl_model("solid\n" + facet + end + "facet normal 0 0 1\nouter loop\nvertex 0 0");
  EXPECT_EQ(cut.meshes[0].indices.size(), 3u);
  EXPECT_EQ(cut.warnings.size(), 1u);
  const Model more = stl_model("solid\n" + facet + end + "endsolid\n" + std::string(5, '\0') + "x y");
  EXPECT_EQ(more.meshes[0].indices.size(), 3u);
  EXPECT_EQ(more.warnings.size(), 1u);
  const Model bad = stl_model("solid\n" + facet + end + "facet normal 1.#QNAN 0 0\nouter loop\nvertex 1.#INF 0 0\nvertex -1.#IND00 0 0\n" +
                              "vertex Infinity 0 0\n" + end);
  EXPECT_EQ(bad.meshes[0].indices.size(), 3u);
  EXPECT_EQ(bad.warnings.size(), 1u);
}

TEST(Stl, OmitsNonFiniteTriangles) {
  std::string bytes = binary_cube("", 0);
  const float infinity = std::numeric_limits<float>::infinity();
  bytes.replace(84 + 12, 4, reinterpret_cast<const char*>(&infinity), 4);
  const Model model = stl_model(bytes);
  EXPECT_EQ(model.meshes[0].indices.size(), 33u);
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(Stl, RejectsDamagedFiles) {
  const auto rejects = [](const std::string& text, const std::string& place, const std::string& keyword) {
    EXPECT_TRUE(reports(input_error([&] { stl_model(text); }), "a.stl: " + place, {keyword, "expected"}));
  };
  rejects("<html>" + std::string(600, 'x'), "", "not an STL file");
  rejects(std::string(20, 'x'), "", "20 bytes");
  rejects(std::string(84, '\0'), "", "no triangles");
  rejects("solid a\nendsolid a\n", "", "no triangles");
  rejects("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "line 5", "ends");
  rejects("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", "line 4", "'x'");
  rejects("solid a\nfacet normal 0 0 1\nouter loop\nendloop\n", "line 4", "'vertex'");
  rejects("solid a\nfaced normal 0 0 1\n", "line 2", "'faced'");
}

}  // namespace
}  // namespace halfspace
