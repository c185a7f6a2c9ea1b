// SPDX-License-Identifier: Apache-2.0
//
// glTF files with KHR_draco_mesh_compression. The meshes are compressed here with libdraco.
#include <draco/compression/encode.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "halfspace/core/tool_folder.h"
#include "halfspace/model/gltf/gltf_draco.h"
#include "model/gltf_builder.h"
#include "support/errors.h"
#include "support/long_tests.h"

namespace halfspace {
namespace {

constexpr int kPositionBits = 14, kNormalBits = 10, kUvBits = 12, kWeightBits = 12;

// A square patch of a wave with size x size vertices. The first joint of each vertex is its vertex index, which compression preserves.
struct Patch {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::u8vec4> colors;
  std::vector<std::array<uint16_t, 4>> joints;
  std::vector<glm::vec4> weights;
  std::vector<uint32_t> indices;

  explicit Patch(uint32_t size) {
    for (uint32_t i = 0; i < size * size; ++i) {
      const float x = static_cast<float>(i % size) / static_cast<float>(size - 1),
                  y = static_cast<float>(i / size) / static_cast<float>(size - 1);
      positions.emplace_back(2.0f * x - 1.0f, 2.0f * y - 1.0f, 0.3f * std::sin(5.0f * x));
      normals.push_back(glm::normalize(glm::vec3(-0.75f * std::cos(5.0f * x), 0.2f * y, 1.0f)));
      uvs.emplace_back(x, 1.0f - y);
      colors.emplace_back(i % 256, 255 - i % 200, 7, 255);
      joints.push_back({static_cast<uint16_t>(i), 1, 0, 0});
      weights.emplace_back(0.75f - 0.5f * x, 0.25f + 0.5f * x, 0.0f, 0.0f);
      if (i % size + 1 == size || i / size + 1 == size) continue;
      indices.insert(indices.end(), {i, i + 1, i + size, i + 1, i + size + 1, i + size});
    }
  }
};

template <class T>
void add_values(draco::Mesh& mesh, draco::GeometryAttribute::Type kind, draco::DataType type, bool normalized,
                const std::vector<T>& values) {
  const auto count = static_cast<uint32_t>(values.size());
  const auto components = sizeof(T) / static_cast<std::size_t>(draco::DataTypeLength(type));
  draco::GeometryAttribute attribute;
  attribute.Init(kind, nullptr, static_cast<uint8_t>(components), type, normalized, sizeof(T), 0);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (uint32_t i = 0; i < count; ++i) mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
}

// Returns the compressed stream. The attributes have the ids 0 to 5, in the order of the members of Patch.
std::vector<std::byte> compressed(const Patch& patch, draco::MeshEncoderMethod method) {
  using Kind = draco::GeometryAttribute;
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<uint32_t>(patch.positions.size()));
  add_values(mesh, Kind::POSITION, draco::DT_FLOAT32, false, patch.positions);
  add_values(mesh, Kind::NORMAL, draco::DT_FLOAT32, false, patch.normals);
  add_values(mesh, Kind::TEX_COORD, draco::DT_FLOAT32, false, patch.uvs);
  add_values(mesh, Kind::COLOR, draco::DT_UINT8, true, patch.colors);
  add_values(mesh, Kind::GENERIC, draco::DT_UINT16, false, patch.joints);
  add_values(mesh, Kind::GENERIC, draco::DT_FLOAT32, false, patch.weights);
  for (std::size_t i = 0; i < patch.indices.size(); i += 3) {
    using draco::PointIndex;
    mesh.AddFace({PointIndex(patch.indices[i]), PointIndex(patch.indices[i + 1]), PointIndex(patch.indices[i + 2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(Kind::POSITION, kPositionBits);
  encoder.SetAttributeQuantization(Kind::NORMAL, kNormalBits);
  encoder.SetAttributeQuantization(Kind::TEX_COORD, kUvBits);
  encoder.SetAttributeQuantization(Kind::GENERIC, kWeightBits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  const auto* first = reinterpret_cast<const std::byte*>(buffer.data());
  return {first, first + buffer.size()};
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

// Returns a file whose only primitive is the stream.
GltfBuilder draco_file(const Patch& patch, const std::vector<std::byte>& stream, bool required = true) {
  GltfBuilder file;
  const std::size_t n = patch.positions.size();
  const auto accessor = [&](int component, const char* type, std::size_t count, bool normalized = false) {
    return file.add("accessors", {{"componentType", component}, {"count", count}, {"type", type}, {"normalized", normalized}});
  };
  const GltfJson attributes = {{"POSITION", accessor(5126, "VEC3", n)},   {"NORMAL", accessor(5126, "VEC3", n)},
                               {"TEXCOORD_0", accessor(5126, "VEC2", n)}, {"COLOR_0", accessor(5121, "VEC4", n, true)},
                               {"JOINTS_0", accessor(5123, "VEC4", n)},   {"WEIGHTS_0", accessor(5126, "VEC4", n)}};
  const GltfJson ids = {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}, {"JOINTS_0", 4}, {"WEIGHTS_0", 5}};
  const int indices = accessor(5125, "SCALAR", patch.indices.size());
  file.mesh_node({{"attributes", attributes},
                  {"indices", indices},
                  {"extensions", {{kDraco, {{"bufferView", file.view(stream)}, {"attributes", ids}}}}}});
  file.json["extensionsUsed"] = {kDraco};
  if (required) file.json["extensionsRequired"] = {kDraco};
  return file;
}

std::string draco_error(const GltfJson& json, const ReadModelOptions& options = {}) {
  return input_error([&] { GltfBuilder::read_text(json.dump(), options); });
}

GltfJson& primitive_of(GltfJson& json) { return json["meshes"][0]["primitives"][0]; }

class GltfDracoTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_decode_draco()) GTEST_SKIP() << "halfspace-draco-tool is not built here (libdraco is absent)";
  }
  void TearDown() override { set_tool_folder({}); }
};

// Quantization to n bits divides the largest extent of an attribute into 2^n − 1 steps; values are off by at most half a step. Normals are
// quantized on an octahedron with 2^n − 1 steps of length 2/(2^n − 1) or less; the projection to the sphere stretches them by less than a
// factor of two. The rest of each bound covers float rounding.
void expect_like(const Patch& patch, const ModelMesh& mesh) {
  constexpr float kPosition = 2.0f / ((1 << kPositionBits) - 1) / 2.0f + 1e-6f, kNormal = 2.0f * 2.0f / ((1 << kNormalBits) - 1);
  constexpr float kUv = 1.0f / ((1 << kUvBits) - 1) / 2.0f + 1e-6f;
  constexpr float kWeight = 2.0f / ((1 << kWeightBits) - 1) / 2.0f + 1e-6f;  // the weights are then scaled so that their sum is 1
  ASSERT_EQ(mesh.positions.size(), patch.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const std::size_t source = mesh.joints[i][0];
    ASSERT_LT(source, patch.positions.size());
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.positions[i][k], patch.positions[source][k], kPosition);
    EXPECT_LT(glm::length(mesh.normals[i] - patch.normals[source]), kNormal);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(mesh.uvs[0][i][k], patch.uvs[source][k], kUv);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(mesh.colors[i][k], static_cast<float>(patch.colors[source][k]) / 255.0f);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(mesh.weights[i][k], patch.weights[source][k], kWeight);
  }
}

// Returns the triangles as vertex numbers of the patch. Each triangle begins with its smallest number, and the triangles are sorted.
std::vector<std::array<uint32_t, 3>> triangles_of(const std::vector<uint32_t>& indices,
                                                  const std::vector<std::array<uint16_t, 4>>& numbers) {
  std::vector<std::array<uint32_t, 3>> list;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    std::array<uint32_t, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = numbers[indices[i + k]][0];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    list.push_back(t);
  }
  std::ranges::sort(list);
  return list;
}

TEST_F(GltfDracoTest, AttributesAndIndicesMatchTheStream) {
  const Patch patch(9);
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Model model = draco_file(patch, compressed(patch, method)).read();
    EXPECT_TRUE(model.warnings.empty()) << model.warnings[0];
    EXPECT_TRUE(model.unsupported_extensions.empty());
    ASSERT_EQ(model.meshes.size(), 1u);
    expect_like(patch, model.meshes[0]);
    EXPECT_EQ(triangles_of(model.meshes[0].indices, model.meshes[0].joints), triangles_of(patch.indices, patch.joints));
  }
}

TEST_F(GltfDracoTest, TriangleStripsAreDecodedAsTriangles) {
  const Patch patch(4);
  GltfJson json = draco_file(patch, compressed(patch, draco::MESH_EDGEBREAKER_ENCODING)).finished();
  primitive_of(json)["mode"] = 5;
  json["accessors"][6]["count"] = 30;  // number of indices of the strip
  const Model model = GltfBuilder::read_text(json.dump());
  EXPECT_EQ(triangles_of(model.meshes[0].indices, model.meshes[0].joints), triangles_of(patch.indices, patch.joints));
}

TEST_F(GltfDracoTest, RejectsAccessorsThatDoNotMatchTheStream) {
  const Patch patch(4);
  const GltfJson good = draco_file(patch, compressed(patch, draco::MESH_SEQUENTIAL_ENCODING)).finished();
  ASSERT_EQ(draco_error(good), "(no error)");
  struct Case {
    void (*damage)(GltfJson&);
    const char* words;
  };
  const Case cases[] = {
      {[](GltfJson& j) { j["accessors"][0]["count"] = 15; }, "has 16 values"},
      {[](GltfJson& j) { j["accessors"][6]["count"] = 51; }, "has 54 values"},
      {[](GltfJson& j) { j["accessors"][3]["componentType"] = 5123; }, "has 4 of type 5121"},
      {[](GltfJson& j) { j["accessors"][0]["type"] = "VEC2"; }, "has 3 of type 5126"},
      {[](GltfJson& j) { j["accessors"][6]["type"] = "VEC2"; }, "SCALAR"},
      {[](GltfJson& j) { primitive_of(j)["mode"] = 1; }, "mode"},
      {[](GltfJson& j) { primitive_of(j).erase("indices"); }, "indices"},
      {[](GltfJson& j) { primitive_of(j)["attributes"].erase("COLOR_0"); }, "COLOR_0"},
      {[](GltfJson& j) { primitive_of(j)["extensions"][kDraco]["attributes"]["NORMAL"] = 77; }, "77"},
      {[](GltfJson& j) { primitive_of(j)["extensions"][kDraco]["bufferView"] = 7; }, "bufferView"},
      {[](GltfJson& j) { primitive_of(j)["extensions"][kDraco].erase("attributes"), primitive_of(j)["mode"] = 6; }, "mode"},
  };
  for (const Case& c : cases) {
    GltfJson json = good;
    c.damage(json);
    EXPECT_TRUE(reports(draco_error(json), "/none/a.gltf: ", {c.words}));
  }
}

TEST_F(GltfDracoTest, DamagedStreamsGiveAMeshOrAOneLineError) {
  const Patch patch(3);
  const std::vector<std::byte> good = compressed(patch, draco::MESH_EDGEBREAKER_ENCODING);
  const auto check = [&](const std::vector<std::byte>& stream) {
    const std::string message = draco_error(draco_file(patch, stream).finished(), {.max_memory = 64u << 20});
    EXPECT_TRUE(message == "(no error)" || reports(message, "/none/a.gltf: ", {"expected"})) << message;
    return message != "(no error)";
  };
  for (std::size_t i = 0; i < good.size(); i += runs_long_tests() ? 1 : 3) {
    const bool rejected = check({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i)});
    EXPECT_TRUE(rejected || i >= good.size() / 2) << "truncated to " << i;
    for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
      std::vector<std::byte> damaged = good;
      damaged[i] ^= static_cast<std::byte>(flip);
      check(damaged);
    }
  }
  EXPECT_EQ(draco_error(draco_file(patch, good).finished()), "(no error)");
}

// The counts are variable-length integers after the 11-byte header.
TEST_F(GltfDracoTest, HugeCountsAreRejected) {
  const Patch patch(3);
  const std::vector<std::byte> good = compressed(patch, draco::MESH_SEQUENTIAL_ENCODING);
  ASSERT_EQ(good[11], std::byte{8});  // triangles
  ASSERT_EQ(good[12], std::byte{9});  // points
  constexpr std::array<std::byte, 5> kMaxVarint = {std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0x0f}};
  for (const auto& [triangles, points] : {std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    std::vector<std::byte> stream(good.begin(), good.begin() + 11);
    triangles ? stream.insert(stream.end(), kMaxVarint.begin(), kMaxVarint.end()) : stream.insert(stream.end(), good[11]);
    points ? stream.insert(stream.end(), kMaxVarint.begin(), kMaxVarint.end()) : stream.insert(stream.end(), good[12]);
    stream.insert(stream.end(), good.begin() + 13, good.end());
    EXPECT_TRUE(reports(draco_error(draco_file(patch, stream).finished(), {.max_memory = 64u << 20}), "/none/a.gltf: ", {"expected"}));
  }
}

TEST_F(GltfDracoTest, MemoryIsLimited) {
  const Patch patch(200);
  const GltfJson json = draco_file(patch, compressed(patch, draco::MESH_EDGEBREAKER_ENCODING)).finished();
  EXPECT_TRUE(reports(draco_error(json, {.max_memory = 4u << 20}), "/none/a.gltf: ", {"expected"}));
  EXPECT_EQ(draco_error(json), "(no error)");
}

TEST_F(GltfDracoTest, FallsBackToUncompressedDataWithoutADecoder) {
  const Patch patch(4);
  const std::vector<std::byte> stream = compressed(patch, draco::MESH_EDGEBREAKER_ENCODING);
  set_tool_folder("/none");
  EXPECT_FALSE(can_decode_draco());
  EXPECT_TRUE(reports(draco_error(draco_file(patch, stream).finished()), "/none/a.gltf: ", {kDraco, "not installed"}));
  EXPECT_TRUE(reports(draco_error(draco_file(patch, stream, false).finished()), "/none/a.gltf: ", {kDraco, "not installed"}));
  GltfBuilder file = draco_file(patch, stream, false);
  file.json["accessors"][0]["bufferView"] = file.view(patch.positions);
  file.json["accessors"][6]["bufferView"] = file.view(patch.indices);
  const Model model = file.read();
  EXPECT_EQ(model.unsupported_extensions, std::vector<std::string>{kDraco});
  EXPECT_EQ(model.warnings.size(), 2u) << "the extension, and the normals of length 0 in accessors without values";
  EXPECT_EQ(model.meshes[0].positions, patch.positions);
  EXPECT_EQ(model.meshes[0].indices, patch.indices);
}

}  // namespace
}  // namespace halfspace
