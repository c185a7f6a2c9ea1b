// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "halfspace/model/model.h"
#include "support/errors.h"
#include "support/folder_test.h"

namespace halfspace {
namespace {

class ReadModelFile : public FolderTest {};

constexpr const char* kByteOrderMark = "\xef\xbb\xbf";
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kStl = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

TEST_F(ReadModelFile, SkipsTheByteOrderMarkOfTextFiles) {
  put("a.mtl", kByteOrderMark + std::string("newmtl red\nKd 1 0 0\n"));
  put("a.obj", kByteOrderMark + ("mtllib a.mtl\nusemtl red\n" + kObj));
  put("a.ply", kByteOrderMark + kPly);
  put("a.stl", kByteOrderMark + kStl);
  for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
    const Model model = read_model(directory / name);
    EXPECT_EQ(model.meshes.at(0).positions.size(), 3u) << name;
    EXPECT_TRUE(model.warnings.empty()) << name;
  }
  EXPECT_EQ(read_model(directory / "a.obj").materials.at(0).base_color, glm::vec4(1, 0, 0, 1));
}

TEST_F(ReadModelFile, TrustsTheContentsMoreThanTheExtension) {
  put("ply.obj", kPly);
  put("stl.obj", kStl);
  put("ply.stl", kPly);
  put("obj.txt", kObj);
  EXPECT_EQ(read_model(directory / "ply.obj").format, "PLY");
  EXPECT_EQ(read_model(directory / "stl.obj").format, "STL");
  EXPECT_EQ(read_model(directory / "ply.stl").format, "PLY");
  EXPECT_EQ(read_model(directory / "obj.txt").format, "OBJ");
}

TEST_F(ReadModelFile, ReportsUtf16) {
  std::string little = "\xff\xfe", big = "\xfe\xff";
  for (const char c : kObj) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& text : {little, big}) {
    const std::filesystem::path file = put("a.obj", text);
    EXPECT_TRUE(reports(input_error([&] { read_model(file); }), file.string(), {"UTF-16", "UTF-8"}));
  }
}

}  // namespace
}  // namespace halfspace
