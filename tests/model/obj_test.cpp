// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/obj_reading.h"
#include "support/errors.h"

namespace halfspace {
namespace {

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string with_triangle(std::string_view text) { return std::string(kTriangle) + std::string(text); }

glm::dvec3 position(const ModelMesh& mesh, std::size_t index) { return mesh.origin + glm::dvec3(mesh.positions[mesh.indices[index]]); }

std::string obj_cube(double size, const glm::dvec3& center) {
  std::string text;
  char line[200];
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 p = center + size * (glm::dvec3(i & 1, i >> 1 & 1, i >> 2) - 0.5);
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    text += line;
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

TEST(Obj, ReadsATriangle) {
  const Model model = read_obj_text(with_triangle("f 1 2 3\n"));
  EXPECT_EQ(model.format, "OBJ");
  EXPECT_EQ(model.up, UpAxis::y);
  ASSERT_EQ(model.meshes.size(), 1u);
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.origin, glm::dvec3(0.5, 0.5, 0));
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {-0.5f, 0.5f, 0}}));
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>(3, {0, 0, 1})));
  EXPECT_TRUE(mesh.uvs[0].empty() && mesh.colors.empty());
  ASSERT_EQ(model.nodes.size(), 1u);
  EXPECT_EQ(model.nodes[0].name, "a");
  EXPECT_EQ(model.nodes[0].meshes, std::vector<int>{0});
  ASSERT_EQ(model.scenes.size(), 1u);
  EXPECT_EQ(model.scenes[0].roots, std::vector<int>{0});
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Obj, DrawsElementsWithoutMaterialInGray) {
  const Model model = read_obj_text(with_triangle("f 1 2 3\n"));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.meshes[0].material, 0);
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(0.8f, 0.8f, 0.8f, 1.0f));
  EXPECT_TRUE(model.materials[0].double_sided);
}

TEST(Obj, ReadsAllFormsOfText) {
  for (const char* text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "\t v\t0 0 0\n  v 1\t\t0 0 \nv 0 1 0 # corner\n\n# f 3 2 1\\\nf 1 2 3 # face\n",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2\\\n3\n", "v 0 \\  \n0 0\nv 1 0 0 \\\r\r\n\nv 0 1 0\nf 1 \\\t # more\n2 \\# more\n3 \\",
        "v 0 0 0\nv 1 0 0\nv 0 1 0 # no \\\n# none\\\nf 1 \\\n# between\n\n 2 3 \\\n# end\n\ng a\n",
        "v +0. .0 0e0\nv 1e0 -0 1e-999\nv 0 +1E+0 0\nf 1 2 3\n", "f 1 2 3\nv 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n"}) {
    const Model model = read_obj_text(text);
    ASSERT_EQ(model.meshes.size(), 1u) << text;
    EXPECT_EQ(position(model.meshes[0], 0), glm::dvec3(0, 0, 0)) << text;
    EXPECT_EQ(position(model.meshes[0], 1), glm::dvec3(1, 0, 0)) << text;
    EXPECT_EQ(position(model.meshes[0], 2), glm::dvec3(0, 1, 0)) << text;
    EXPECT_TRUE(model.warnings.empty()) << text;
  }
}

TEST(Obj, ResolvesNegativeIndices) {
  const Model model = read_obj_text(with_triangle("vt 0 0\nvt 1 0\nvn 0 1 0\nf -3/-2/-1 -2/-1/-1 -1/-1/-1\nv 9 9 9\n"));
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(position(mesh, 1), glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.uvs[0], (std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 1}}));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>(3, {0, 1, 0})));
}

TEST(Obj, FlipsTextureCoordinates) {
  const Model model = read_obj_text(with_triangle("vt 0.25 0.125\nvt 2\nf 1/1 2/2 3\n"));
  EXPECT_EQ(model.meshes[0].uvs[0], (std::vector<glm::vec2>{{0.25f, 0.875f}, {2, 1}, {0, 1}}));
}

TEST(Obj, SharesVerticesWithEqualIndices) {
  const Model model = read_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1\nf 1/1 3/2 4/1\n");
  EXPECT_EQ(model.meshes[0].positions.size(), 5u);
  EXPECT_EQ(model.meshes[0].indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 4, 3}));
}

TEST(Obj, NormalizesNormals) {
  const Model model = read_obj_text(with_triangle("vn 0 3e-17 -4e-17\nf 1//1 2//1 3//1\n"));
  for (const glm::vec3& normal : model.meshes[0].normals) EXPECT_EQ(normal, glm::vec3(0, 0.6f, -0.8f));
}

TEST(Obj, ReplacesUnusableNormals) {
  for (const char* normal : {"0 0 0", "nan 0 1", "-nan(ind) 0 0", "0 1", "inf 0 0", "x y z"}) {
    const Model model = read_obj_text(with_triangle(std::string("vn ") + normal + "\nvn 0 0 -1\nf 1//1 2//1 3//1\nf 1//2 2//2 3//2\n"));
    ASSERT_EQ(model.meshes.size(), 2u) << normal;
    EXPECT_EQ(model.meshes[0].normals, (std::vector<glm::vec3>(3, {0, 0, 1}))) << normal;
    EXPECT_EQ(model.meshes[1].normals, (std::vector<glm::vec3>(3, {0, 0, -1}))) << normal;
    EXPECT_EQ(model.warnings.size(), 1u) << normal;
  }
}

// Two squares that meet at a right angle at the edge 2-3.
constexpr std::string_view kFold = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n";

TEST(Obj, UsesSmoothingGroups) {
  const auto vertices = [](const std::string& faces) { return read_obj_text(std::string(kFold) + faces).meshes[0].positions.size(); };
  EXPECT_EQ(vertices("f 1 2 3 4\nf 2 5 6 3\n"), 8u) << "sharper than the crease angle";
  EXPECT_EQ(vertices("s 1\nf 1 2 3 4\nf 2 5 6 3\n"), 6u) << "one group";
  EXPECT_EQ(vertices("s 1\nf 1 2 3 4\ns 2\nf 2 5 6 3\n"), 8u) << "two groups";
  EXPECT_EQ(vertices("s on\nf 1 2 3 4\nf 2 5 6 3\n"), 6u);
  EXPECT_GE(vertices("s off\nf 1 2 3 4\nf 2 5 6 3\n"), 8u);
}

TEST(Obj, UsesTheCreaseAngleOfTheOptions) {
  ReadModelOptions options;
  options.crease_degrees = 91.0f;
  EXPECT_EQ(read_obj_text(std::string(kFold) + "f 1 2 3 4\nf 2 5 6 3\n", options).meshes[0].positions.size(), 6u);
}

TEST(Obj, TriangulatesPolygons) {
  const Model model = read_obj_text("v 0 0 0\nv 4 1 0\nv 0 2 0\nv 3 1 0\nf 1 2 3 4\n");
  const std::vector<uint32_t>& indices = model.meshes[0].indices;
  ASSERT_EQ(indices.size(), 6u);
  EXPECT_EQ(std::ranges::count(indices, 3u), 2) << "must be cut at the reflex vertex";
  EXPECT_EQ(std::ranges::count(indices, 1u), 2);
}

TEST(Obj, ReadsLinesAndPoints) {
  const Model model = read_obj_text(with_triangle("l 1 2 3\nl 3/1 1/1\np 2 3\n"));
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].topology, MeshTopology::lines);
  EXPECT_EQ(model.meshes[0].indices, (std::vector<uint32_t>{0, 1, 1, 2, 2, 0}));
  EXPECT_EQ(model.meshes[1].topology, MeshTopology::points);
  EXPECT_EQ(model.meshes[1].indices, (std::vector<uint32_t>{0, 1}));
}

TEST(Obj, OmitsElementsWithTooFewVertices) {
  const Model model = read_obj_text(with_triangle("f 1 2\nf 1 2 3\nf 3 1\nf 1 2 3\nl 1\np\nf 1\n"));
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].indices, (std::vector<uint32_t>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(Obj, DrawsVerticesWithoutElementsAsPoints) {
  const Model model = read_obj_text(kTriangle);
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].topology, MeshTopology::points);
  EXPECT_EQ(model.meshes[0].indices.size(), 3u);
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(Obj, DecodesVertexColors) {
  const Model model = read_obj_text("v 0 0 0 1 0 0.5\nv 1 0 0 0 1 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(model.meshes[0].colors.size(), 3u);
  const glm::vec4 first = model.meshes[0].colors[0];
  EXPECT_EQ(first.x, 1.0f);
  EXPECT_EQ(first.y, 0.0f);
  EXPECT_NEAR(first.z, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-5);
  EXPECT_EQ(first.w, 1.0f);
  EXPECT_EQ(model.meshes[0].colors[2], glm::vec4(1.0f)) << "a vertex without color is white";
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(1.0f));
  const Model late = read_obj_text("v 0 0 0\nv 1 0 0 1 0 0\nv 0 1 0 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(late.meshes[0].colors, (std::vector<glm::vec4>{{1, 1, 1, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}));
  const Model codes = read_obj_text("v 0 0 0 255 0 127.5\nv 1 0 0 0 255 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(codes.meshes[0].colors[0], first);
}

TEST(Obj, MakesOneMeshPerMaterialAndTopology) {
  TemporaryFolder folder;
  write_bytes(folder.path() / "a.mtl", "newmtl red\nKd 1 0 0\nnewmtl dark blue\nKd 0 0 1\n");
  const Model model = read_obj_text(with_triangle("mtllib a.mtl\no box\nusemtl red\nf 1 2 3\ng lid\nusemtl dark blue\nf 1 2 3\nl 1 2\n"
                                                  "o other\nusemtl red\nf 3 2 1\n"),
                                    {}, folder.path() / "a.obj");
  ASSERT_EQ(model.meshes.size(), 3u);
  EXPECT_EQ(model.meshes[0].name, "box");
  EXPECT_EQ(model.meshes[0].indices.size(), 6u);
  EXPECT_EQ(model.meshes[1].name, "lid");
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].name, "red");
  EXPECT_EQ(model.materials[1].name, "dark blue");
  EXPECT_EQ(model.meshes[0].material, 0);
  EXPECT_EQ(model.meshes[1].material, 1);
  EXPECT_EQ(model.meshes[2].material, 1);
  EXPECT_EQ(model.nodes[0].meshes, (std::vector<int>{0, 1, 2}));
}

// Positions relative to the mesh's origin must not depend on the location of the cube, and must be proportional to its size.
TEST(Obj, KeepsPrecisionFarAwayAndAtAllSizes) {
  const ModelMesh near = read_obj_text(obj_cube(0.75, glm::dvec3(0.0))).meshes[0];
  const ModelMesh far = read_obj_text(obj_cube(0.75, glm::dvec3(5e6))).meshes[0];
  EXPECT_EQ(near.positions, far.positions);
  EXPECT_EQ(far.origin, glm::dvec3(5e6));
  for (const double size : {0x1p-20, 0x1p20}) {
    const ModelMesh scaled = read_obj_text(obj_cube(0.75 * size, glm::dvec3(0.0))).meshes[0];
    ASSERT_EQ(scaled.positions.size(), near.positions.size());
    EXPECT_EQ(scaled.indices, near.indices);
    for (std::size_t i = 0; i < near.positions.size(); ++i) {
      EXPECT_EQ(scaled.positions[i], near.positions[i] * static_cast<float>(size));
      EXPECT_EQ(scaled.normals[i], near.normals[i]);
    }
  }
}

TEST(Obj, GivesAllMeshesOneOrigin) {
  const Model model = read_obj_text(with_triangle("v 10 20 30\nf 1 2 3\nl 1 4\n"));
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].origin, glm::dvec3(5, 10, 15));
  EXPECT_EQ(model.meshes[1].origin, glm::dvec3(5, 10, 15));
  const Model unused = read_obj_text(with_triangle("v 10 20 30\nf 1 2 3\n"));
  EXPECT_EQ(unused.meshes[0].origin, glm::dvec3(0.5, 0.5, 0)) << "unused vertices do not count";
}

TEST(Obj, SkipsFacesWithCoordinatesThatAreNotFinite) {
  for (const char* number :
       {"nan",    "NAN",     "-nan",     "nan(ind)", "-nan(ind)", "NaNQ",   "inf",    "-inf",      "+Inf", "Infinity",      "1e400",
        "-1e400", "1.#QNAN", "-1.#QNAN", "1.#SNAN",  "-1.#IND00", "1.#IND", "1.#INF", "-1.#INF00", "1.#J", "1.#INF000e+000"}) {
    const Model model =
        read_obj_text(with_triangle(std::string("v 5 ") + number + " 0\nf 1 2 3\nf 1 2 4\nf 1 4 3\nl 4 1 2 4 3 1\np 4 1\n"));
    ASSERT_EQ(model.meshes.size(), 3u) << number;
    EXPECT_EQ(model.meshes[0].indices.size(), 3u) << number;
    EXPECT_EQ(model.meshes[0].origin, glm::dvec3(0.5, 0.5, 0)) << number;
    EXPECT_EQ(model.meshes[1].indices.size(), 4u) << "two segments";
    EXPECT_EQ(model.meshes[2].indices.size(), 1u);
    ASSERT_EQ(model.warnings.size(), 1u) << number;
    EXPECT_NE(model.warnings[0].find("4 faces"), std::string::npos) << model.warnings[0];
  }
  EXPECT_TRUE(read_obj_text(with_triangle("v nan 0 0\nf 1 2 3\n")).warnings.empty()) << "not used";
  const Model points = read_obj_text("v 0 0 0\nv nan 0 0\nv 1 1 1\n");
  EXPECT_EQ(points.meshes[0].positions.size(), 2u);
  EXPECT_TRUE(reports(input_error([] { read_obj_text("v 0 0 inf\n"); }), "/none/a.obj: ", {"finite", "expected"}));
}

TEST(Obj, ReplacesAttributesThatAreNotFinite) {
  const Model model = read_obj_text(
      "v 0 0 0 1 0 0\nv 1 0 0 nan 0 0\nv 0 1 0 0 1.#INF 0\nvt 1.#QNAN 0.5\nvt 1 1 nan\nvn -1.#IND 0 1\n"
      "f 1/1/1 2/2/1 3/2/1\n");
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec4>{{1, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}));
  EXPECT_EQ(mesh.uvs[0], (std::vector<glm::vec2>{{0, 1}, {1, 0}, {1, 0}}));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>(3, {0, 0, 1})));
  EXPECT_EQ(model.warnings.size(), 3u);
}

TEST(Obj, UnusedColorsDoNotDecideTheRange) {
  const Model model = read_obj_text("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 0 255 0 0\nf 1 2 3\n");
  EXPECT_EQ(model.meshes[0].colors[0], glm::vec4(1, 0, 0, 1));
}

// A concave pentagon of area 2.5, whose corners are repeated by index or by position.
TEST(Obj, RepeatedCornersOfAFaceAreOneCorner) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nv 2 0 0\nvt 0 0\nvt 1 1\n";
  for (const char* face : {"1 2 3 4 5", "1 1 2 2 3 4 4 5 5", "1/1 1/2 2 3 4 5 -6", "1 2 6 3 4 5", "5 1 1 2 6 3 4 5"}) {
    const Model model = read_obj_text(corners + "f " + face + "\n");
    const ModelMesh& mesh = model.meshes[0];
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::dvec3 a = position(mesh, t), b = position(mesh, t + 1), c = position(mesh, t + 2);
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_EQ(area, 2.5) << face;
    EXPECT_EQ(mesh.positions.size(), 5u) << face;
    EXPECT_TRUE(model.warnings.empty()) << face;
  }
  const Model model = read_obj_text(with_triangle("v 9 9 9\nf 1 2 3\nf 4 4 1\nf 4 4 4 4\nl 4 4\nl 1 2 3 1\n"));
  EXPECT_EQ(model.meshes[0].origin, glm::dvec3(0.5, 0.5, 0)) << "skipped faces use no vertices";
  EXPECT_EQ(model.meshes[1].indices.size(), 6u) << "a closed polyline";
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(Obj, NamesTheLineOfErrors) {
  const auto error = [](std::string_view text) { return input_error([&] { read_obj_text(text); }); };
  EXPECT_TRUE(reports(error("v 0 0 0\nv 1 x 0\n"), "/none/a.obj:2: ", {"'x'", "expected"}));
  EXPECT_TRUE(reports(error("v 0 0 \\\n0\nv 1 0\n"), "/none/a.obj:3: ", {"2", "expected 3"}));
  for (const char* number : {"-1e19", "1,5", "3.1+e2", "++1", "+-1", "0x1p3x", "1e", "-"}) {
    EXPECT_TRUE(reports(error(std::string("\nv 0 0 ") + number), "/none/a.obj:2: ", {number, "expected"}));
  }
  for (const char* corner : {"0", "4", "-4", "99999999999", "-99999999999999999999", "4294967295", "4294967296"}) {
    EXPECT_TRUE(reports(error(with_triangle(std::string("f 1 2 ") + corner + "\nf 1 2 3\n")), "/none/a.obj:4: ", {"index", "expected"}))
        << corner;
  }
  for (const char* corner : {"a", "/1", "1/x", "1/1/1/1", "1.5", "//", "3\"", "\"quoted"}) {
    EXPECT_TRUE(reports(error(with_triangle(std::string("f 1 2 ") + corner)), "/none/a.obj:4: ", {"indices", "expected"})) << corner;
  }
  EXPECT_TRUE(reports(error(""), "/none/a.obj: ", {"no vertices", "expected"}));
  EXPECT_TRUE(reports(error("f 1 2 3\n"), "/none/a.obj:1: ", {"index 3", "expected"}));
}

TEST(Obj, EscapesControlCharactersInMessages) {
  const std::string error = input_error([] { read_obj_text(std::string_view("v 0 0 \x1b[31m\0\x07\n", 13)); });
  for (const char c : error) EXPECT_GE(c, ' ');
  EXPECT_LT(input_error([] { read_obj_text("v 0 0 " + std::string(1000000, 'z')); }).size(), 400u);
}

TEST(Obj, WarnsOnceForEachKindOfUnusedStatement) {
  const Model model =
      read_obj_text(with_triangle("f 1 2 3\nf 1 2\nf 1\nl 1\ncurv 0 1 1 2 3\nsurf 1\nvp 1\nfoo\nbar\nf 1/9/9 2 3\nvt x\nvt y\nusemtl a\n"
                                  "f 1 2 3\nusemtl b\nf 1 2 3\nlod 3\nbevel on\n"));
  EXPECT_EQ(model.warnings.size(), 7u) << "few corners, curves, unknown, texture coordinates, 2 index ranges, undefined materials";
  const std::set<std::string> distinct(model.warnings.begin(), model.warnings.end());
  EXPECT_EQ(distinct.size(), 7u);
}

TEST(Obj, RejectsFilesLargerThanMemory) {
  ReadModelOptions options;
  options.max_memory = 400;
  EXPECT_TRUE(reports(input_error([&] { read_obj_text(with_triangle("f 1 2 3 # 0123456789012345678901234567890123456789\n"), options); }),
                      "/none/a.obj: ", {"memory", "expected at most"}));
}

}  // namespace
}  // namespace halfspace
