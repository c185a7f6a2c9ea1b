// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "halfspace/core/srgb.h"
#include "halfspace/model/normals.h"
#include "halfspace/model/read_stl.h"
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
  rejects(binary_cube("", 0).substr(0, 600), "", "declares 12 triangles");
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
