// SPDX-License-Identifier: Apache-2.0
//
// Files and image sizes that exceed --max-memory, --max-pixels or --max-primitives end the program with one line, before anything is
// decoded or drawn.
#include <fstream>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"
#include "image/image_files.h"

namespace halfspace {
namespace {

class Limits : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }
  // Writes a triangle with this texture.
  void write_model(const std::string& texture) const {
    write("a.mtl", "newmtl m\nmap_Kd " + texture + "\n");
    write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  }
  // Checks that the program exits with code 3 and prints one line that contains the words.
  void expect_rejected(std::vector<std::string> arguments, const std::vector<std::string>& words) const {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, 3) << arguments[0] << ": " << o.err;
    EXPECT_EQ(lines_of(o.err), 1) << o.err;
    for (const std::string& word : words) EXPECT_NE(o.err.find(word), std::string::npos) << word << " is not in: " << o.err;
  }
};

TEST_F(Limits, TextureOfSixtyThousandPixelsPerSide) {
  const std::string header = big_endian(60000, 4) + big_endian(60000, 4) + std::string{8, 6, 0, 0, 0};
  write("bomb.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", stored_zlib("")) + png_chunk("IEND", ""));
  write_model("bomb.png");
  expect_rejected({"render", "a.obj", "--size", "64x36"}, {"bomb.png", "60000x60000"});
}

TEST_F(Limits, TextureThatIsValidButExceedsTheLimits) {
  write_png(directory / "large.png", Image<glm::u8vec4>(4096, 4096));
  write_model("large.png");
  expect_rejected({"render", "a.obj", "--size", "64x36", "--max-memory", "100M"}, {"large.png", "208 MiB", "100 MiB (--max-memory)"});
  expect_rejected({"render", "a.obj", "--size", "64x36", "--max-pixels", "16777215"}, {"large.png", "4096x4096", "16777215"});
  EXPECT_EQ(run({"render", "a.obj", "--size", "64x36", "--max-pixels", "16777216"}).exit_code, 0);
}

// Two images of 64 MiB and the results of their conversion fit, but not the textures that are made of them.
TEST_F(Limits, ConvertedTextures) {
  write_png(directory / "large.png", Image<glm::u8vec4>(4096, 4096));
  write("a.gltf", R"({"asset": {"version": "2.0"}, "images": [{"uri": "large.png"}], "textures": [{"source": 0}],
    "materials": [{"name": "m", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseTexture": {"index": 0},
                                                                        "specularGlossinessTexture": {"index": 0}}}}],
    "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0},
                  {"componentType": 5126, "count": 3, "type": "VEC2"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}], "nodes": [{"mesh": 0}]})");
  expect_rejected({"render", "a.gltf", "--size", "64x36", "--max-memory", "350M"}, {"a.gltf", "350 MiB (--max-memory)"});
}

TEST_F(Limits, PlyThatDeclaresABillionVertices) {
  write("a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty uchar x\nend_header\n");
  expect_rejected({"render", "a.ply"}, {"a.ply", "1000000000"});
  expect_rejected({"info", "a.ply"}, {"a.ply", "1000000000"});
}

// Accessors without a buffer view contain zeros, so the file needs no data.
TEST_F(Limits, GltfAccessorWithTwoBillionElements) {
  write("a.gltf", R"({"asset": {"version": "2.0"}, "accessors": [{"componentType": 5126, "count": 2147483648, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]})");
  expect_rejected({"render", "a.gltf"}, {"a.gltf", "--max-memory"});
  expect_rejected({"info", "a.gltf", "--max-memory", "1G"}, {"a.gltf", "needs 8192 MiB", "expected at most 1024 MiB (--max-memory)"});
}

TEST_F(Limits, LargeFile) {
  write("a.stl", "solid a\n");
  fs::resize_file(directory / "a.stl", std::uintmax_t{1} << 36);  // without using any space
  expect_rejected({"info", "a.stl"}, {"a.stl", "68719476736 bytes", "--max-memory"});
}

// Each light of a model file has shadow maps, and a small file can contain many lights.
TEST_F(Limits, ShadowMaps) {
  expect_rejected(
      {"render", "earth", "--size", "64x36", "--set", "shadow.method=hard", "--set", "shadow.resolution=8192", "--max-memory", "200M"},
      {"lights.sun", "shadow maps", "512 MiB", "--max-memory"});
}

// A small file can place a mesh many times.
TEST_F(Limits, PlacedPrimitives) {
  write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"mesh":0},{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"mode":0}]}],
    "accessors":[{"componentType":5126,"count":60,"type":"VEC3"}]})");
  // Three copies of 20 triangles, 30 lines and 60 points.
  expect_rejected({"render", "a.gltf", "--size", "64x36", "--max-primitives", "329"}, {"a.gltf: draws 330", "--max-primitives"});
  EXPECT_EQ(run({"render", "a.gltf", "--size", "64x36", "--max-primitives", "330"}).exit_code, 0);
}

TEST_F(Limits, SizeOfTheOutput) {
  expect_rejected({"render", "earth", "-o", "a.exr", "--size", "16384x16384", "--max-memory", "1G"}, {"--size 16384x16384", "4096 MiB"});
  expect_rejected({"render", "earth", "--size", "100x50", "--max-pixels", "4999"}, {"--size", "100x50", "4999"});
  EXPECT_TRUE(files().empty());
}

TEST_F(Limits, RejectsInvalidValues) {
  for (const char* value : {"0", "1K", "x", "5X", "-1", "99999999999G", "4 G", "1M2"}) {
    const Outcome o = run({"render", "earth", "--max-memory", value});
    EXPECT_EQ(o.exit_code, 2) << value;
    EXPECT_NE(o.err.find("--max-memory"), std::string::npos);
  }
  for (const char* value : {"0", "268435457", "1M"}) EXPECT_EQ(run({"info", "--max-pixels", value}).exit_code, 2) << value;
  EXPECT_EQ(run({"info", "--max-memory", "3G", "--max-pixels", "268435456"}).exit_code, 0);
  for (const char* value : {"0", "-1", "1e3", "2147483648"})
    EXPECT_EQ(run({"render", "earth", "--max-primitives", value}).exit_code, 2) << value;
  EXPECT_EQ(run({"render", "earth", "--size", "8x8", "--max-primitives", "2147483647"}).exit_code, 0);
}

// A material library that exceeds the memory limit is an error; all other problems of material libraries are warnings.
TEST_F(Limits, MaterialLibrary) {
  write("a.mtl", "newmtl m\n#" + std::string(std::size_t{13} << 20, '#') + "\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_rejected({"render", "a.obj", "--size", "64x36", "--max-memory", "100M"}, {"a.mtl", "--max-memory"});
}

TEST_F(Limits, MapsThatExportCombines) {
  write_png(directory / "a.png", Image<glm::u8vec4>(64, 64));
  write("a.mtl", "newmtl m\nPr 1\nPm 1\nmap_Pr a.png\nmap_Pm a.png\n");
  write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  expect_rejected({"export", "a.obj", "-o", "b.glb", "--max-pixels", "1000"}, {"a.png", "64x64", "--max-pixels"});
  EXPECT_EQ(run({"export", "a.obj", "-o", "b.glb"}).exit_code, 0);
}

}  // namespace
}  // namespace halfspace
