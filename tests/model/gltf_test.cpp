// SPDX-License-Identifier: Apache-2.0
//
// Meshes, nodes, cameras and lights of glTF files.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/model/gltf/gltf_buffers.h"
#include "halfspace/model/pose/pose.h"
#include "model/gltf_builder.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

using Indices = std::vector<uint32_t>;

// Reads a mesh with vertices at (i, 0, 0). mode: the primitive mode; indices: may be empty.
ModelMesh read_mode(int mode, const std::vector<uint8_t>& indices, int points = 5) {
  GltfBuilder file;
  std::vector<float> positions;
  for (int i = 0; i < points; ++i) positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0.0f});
  GltfJson primitive = {{"attributes", {{"POSITION", file.accessor(positions, 3)}, {"NORMAL", file.accessor(positions, 3)}}},
                        {"mode", mode}};
  if (!indices.empty()) primitive["indices"] = file.accessor(indices, 1);
  file.mesh_node(primitive);
  return file.read().meshes.at(0);
}

TEST(Gltf, ReadsATriangle) {
  GltfBuilder file;
  file.mesh_node({{"attributes", {{"POSITION", file.triangle()}}}});
  const Model model = file.read();
  EXPECT_EQ(model.format, "glTF");
  ASSERT_EQ(model.meshes.size(), 1u);
  const ModelMesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
  EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
  ASSERT_EQ(model.scenes.size(), 1u);
  EXPECT_EQ(model.scenes[0].roots, std::vector<int>{0});
  // The default material of glTF is a rough metal.
  const ModelMaterial& material = model.materials.at(static_cast<std::size_t>(mesh.material));
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Gltf, ConvertsAllModesToLists) {
  EXPECT_EQ(read_mode(0, {}).indices, Indices());
  EXPECT_EQ(read_mode(0, {1, 3}).positions.size(), 2u);
  EXPECT_EQ(read_mode(0, {}).topology, MeshTopology::points);
  EXPECT_EQ(read_mode(1, {0, 1, 2, 3, 4, 0}).indices, (Indices{0, 1, 2, 3, 4, 0}));
  EXPECT_EQ(read_mode(1, {}).indices, (Indices{0, 1, 2, 3}));  // the fifth vertex has no partner
  EXPECT_EQ(read_mode(2, {}, 3).indices, (Indices{0, 1, 1, 2, 2, 0}));
  EXPECT_EQ(read_mode(3, {}, 3).indices, (Indices{0, 1, 1, 2}));
  EXPECT_EQ(read_mode(3, {}).topology, MeshTopology::lines);
  EXPECT_EQ(read_mode(4, {4, 3, 2, 2, 1, 0}).indices, (Indices{4, 3, 2, 2, 1, 0}));
  EXPECT_EQ(read_mode(5, {}).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(read_mode(5, {4, 3, 2, 1}).indices, (Indices{3, 2, 1, 2, 0, 1}));  // vertex 0 is not used
  EXPECT_EQ(read_mode(6, {}).indices, (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
  EXPECT_EQ(read_mode(6, {}).topology, MeshTopology::triangles);
}

TEST(Gltf, KeepsOnlyTheVerticesThatAPrimitiveUses) {
  const ModelMesh mesh = read_mode(4, {4, 1, 3});
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{1, 1, 0}, {3, 9, 0}, {4, 16, 0}}));
  EXPECT_EQ(mesh.indices, (Indices{2, 0, 1}));
}

TEST(Gltf, NormalizesIntegers) {
  GltfBuilder file;
  const int p = file.triangle();
  const int uv = file.accessor<uint16_t>({0, 65535, 13107, 0, 0, 0}, 2, true);
  const int colors = file.accessor<uint8_t>({255, 51, 0, 102, 0, 0, 0, 0, 255, 255, 255, 255}, 4, true);
  const int n = file.accessor<int8_t>({127, 0, 0, 0, -128, 0, 0, 0, -127}, 3, true);
  file.mesh_node({{"attributes", {{"POSITION", p}, {"TEXCOORD_1", uv}, {"COLOR_0", colors}, {"NORMAL", n}}}});
  const ModelMesh mesh = file.read().meshes.at(0);
  EXPECT_TRUE(mesh.uvs[0].empty());
  EXPECT_EQ(mesh.uvs[1], (std::vector<glm::vec2>{{0.0f, 1.0f}, {0.2f, 0.0f}, {0.0f, 0.0f}}));
  EXPECT_EQ(mesh.colors[0], glm::vec4(1.0f, 0.2f, 0.0f, 0.4f));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}));
}

TEST(Gltf, ReadsQuantizedPositionsAsTheyAre) {
  GltfBuilder file;
  const int view = file.view(std::vector<int16_t>{-7, 5, 300, 0, 1, 2, 3, 0, 4, 5, 6, 0}, 8);
  const int p = file.add("accessors", {{"bufferView", view}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}});
  file.mesh_node({{"attributes", {{"POSITION", p}}}});
  EXPECT_EQ(file.read().meshes.at(0).positions, (std::vector<glm::vec3>{{-7, 5, 300}, {1, 2, 3}, {4, 5, 6}}));
}

TEST(Gltf, ReadsInterleavedAttributes) {
  GltfBuilder file;
  std::vector<float> data;
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(i);
    data.insert(data.end(), {x, x * x, 0.0f, 0.0f, 0.0f, 1.0f, x / 4.0f, 0.5f});
  }
  const int view = file.view(data, 32);
  const auto attribute = [&](int offset, const char* type) {
    return file.add("accessors", {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", type}});
  };
  file.mesh_node(
      {{"attributes", {{"POSITION", attribute(0, "VEC3")}, {"NORMAL", attribute(12, "VEC3")}, {"TEXCOORD_0", attribute(24, "VEC2")}}}});
  const ModelMesh mesh = file.read().meshes.at(0);
  EXPECT_EQ(mesh.positions[2], glm::vec3(2, 4, 0));
  EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.uvs[0][2], glm::vec2(0.5f, 0.5f));
}

TEST(Gltf, AppliesSparseValues) {
  for (const bool has_base : {false, true}) {
    GltfBuilder file;
    GltfJson accessor = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
    if (has_base) accessor["bufferView"] = file.view(std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3});
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", file.view(std::vector<uint16_t>{0, 2})}, {"componentType", 5123}}},
                          {"values", {{"bufferView", file.view(std::vector<float>{7, 8, 9, 4, 5, 6})}}}};
    file.mesh_node({{"attributes", {{"POSITION", file.add("accessors", accessor)}}}});
    const float middle = has_base ? 2.0f : 0.0f;
    EXPECT_EQ(file.read().meshes.at(0).positions, (std::vector<glm::vec3>{{7, 8, 9}, glm::vec3(middle), {4, 5, 6}}));
  }
}

// The last index is not exact as a float.
TEST(Gltf, AppliesSparseIntegers) {
  constexpr uint32_t kVertices = 3, kLarge = 0x01000001;
  GltfBuilder file;
  GltfJson accessor = {{"componentType", 5125}, {"count", 3}, {"type", "SCALAR"}};
  accessor["bufferView"] = file.view(std::vector<uint32_t>{0, 1, 1});
  const auto sparse = [&](uint32_t value) {
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", file.view(std::vector<uint8_t>{2})}, {"componentType", 5121}}},
                          {"values", {{"bufferView", file.view(std::vector<uint32_t>{value})}}}};
    return file.add("accessors", accessor);
  };
  const int p = file.triangle();
  file.mesh_node({{"attributes", {{"POSITION", p}}}, {"indices", sparse(2)}});
  EXPECT_EQ(file.read().meshes.at(0).indices, (std::vector<uint32_t>{0, 1, kVertices - 1}));
  file.json["meshes"][0]["primitives"][0]["indices"] = sparse(kLarge);
  try {
    file.read();
    FAIL() << "the index is out of range";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(std::to_string(kLarge)), std::string::npos) << e.what();
  }
}

// Features without an effect are named, each in one line.
TEST(Gltf, NamesFeaturesThatAreIgnored) {
  GltfBuilder file;
  const int p = file.triangle(), uv = file.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
  file.mesh_node({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", uv}}}, {"targets", {{{"TEXCOORD_0", uv}}, {{"TEXCOORD_0", uv}}}}});
  file.json["nodes"][0]["scale"] = {1, 0, 1};
  file.add("nodes", {{"mesh", 0}, {"scale", {0, 0, 0}}});  // hidden on purpose
  const std::vector<std::string> warnings = file.read().warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("morph targets of texture coordinates"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("nodes[0]"), std::string::npos) << warnings[1];
}

TEST(Gltf, ReadsMorphTargetsSkinsAndInstances) {
  GltfBuilder file;
  const int p = file.triangle(), offsets = file.accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, 3);
  const int joints = file.accessor<uint8_t>({1, 0, 9, 9, 0, 1, 0, 0, 0, 0, 0, 0}, 4);
  const int weights = file.accessor<float>({2, 2, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4);
  const int node = file.mesh_node({{"attributes", {{"POSITION", p}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                                   {"targets", {{{"POSITION", offsets}}, {{"POSITION", offsets}}}}});
  file.json["meshes"][0]["weights"] = {0.25, 0.5};
  std::vector<float> matrices(32, 0.0f);
  for (const std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u}) matrices[i] = 1.0f;
  matrices[12] = 3.0f;
  file.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", file.accessor(matrices, 16)}});
  file.add("nodes", GltfJson::object());
  file.add("nodes", GltfJson::object());
  file.json["nodes"][static_cast<std::size_t>(node)]["skin"] = 0;
  file.json["nodes"][static_cast<std::size_t>(node)]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.accessor<float>({1, 2, 3, 4, 5, 6}, 3)},
      {"ROTATION", file.accessor<int16_t>({0, 0, 32767, 0, 0, 0, 0, 32767}, 4, true)}};
  const Model model = file.read();
  const ModelMesh& mesh = model.meshes.at(0);
  ASSERT_EQ(mesh.targets.size(), 2u);
  EXPECT_EQ(mesh.targets[1].positions[2], glm::vec3(0, 0, 3));
  EXPECT_EQ(mesh.joints[0], (std::array<uint16_t, 4>{1, 0, 0, 0}));  // joints with a weight of 0 become 0
  EXPECT_EQ(mesh.weights[0], glm::vec4(0.5f, 0.5f, 0.0f, 0.0f));
  EXPECT_EQ(mesh.weights[2], glm::vec4(1.0f, 0.0f, 0.0f, 0.0f));
  EXPECT_EQ(model.nodes[0].morph_weights, (std::vector<float>{0.25f, 0.5f}));
  EXPECT_EQ(model.skins.at(0).joints, (std::vector<int>{1, 2}));
  EXPECT_EQ(model.skins[0].joint_from_mesh[0][3], glm::dvec4(3, 0, 0, 1));
  ASSERT_EQ(model.nodes[0].instances.size(), 2u);
  EXPECT_EQ(model.nodes[0].instances[1].translation, glm::dvec3(4, 5, 6));
  EXPECT_EQ(model.nodes[0].instances[0].rotation.z, 1.0);
}

TEST(Gltf, ReadsNodesScenesCamerasAndLights) {
  GltfBuilder file;
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}, {"name", "eye"}});
  file.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 40}, {"color", {1, 0.5, 0}}, {"range", 7}, {"spot", {{"innerConeAngle", 0.1}}}}};
  file.add("nodes", {{"camera", 1}, {"children", {2, 1}}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 3, 4}}, {"scale", {2, 2, -2}}});
  file.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"name", "lamp"}});
  file.add("nodes", {{"matrix", {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1}}});
  file.add("scenes", {{"nodes", {0}}});
  file.add("scenes", {{"name", "second"}});
  file.json["scene"] = 1;
  const Model model = file.read();
  EXPECT_EQ(model.cameras.at(0).fovy, 0.5);
  EXPECT_EQ(model.cameras[0].near, 0.25);
  EXPECT_EQ(model.cameras[0].far, std::numeric_limits<double>::infinity());
  EXPECT_EQ(model.cameras[0].name, "eye");
  EXPECT_FALSE(model.cameras.at(1).perspective);
  EXPECT_EQ(model.cameras[1].height, 6.0);
  const ModelLight& light = model.lights.at(0);
  EXPECT_EQ(light.type, ModelLightType::spot);
  EXPECT_EQ(light.intensity, 40.0);
  EXPECT_EQ(light.color, glm::vec3(1.0f, 0.5f, 0.0f));
  EXPECT_EQ(light.range, 7.0);
  EXPECT_EQ(light.inner, 0.1);
  EXPECT_EQ(light.outer, std::numbers::pi / 4.0);
  EXPECT_EQ(model.nodes[0].children, (std::vector<int>{2, 1}));
  EXPECT_DOUBLE_EQ(model.nodes[0].transform.rotation.z, 0.6);  // scaled to unit length
  EXPECT_DOUBLE_EQ(model.nodes[0].transform.rotation.w, 0.8);
  EXPECT_EQ(model.nodes[0].transform.scale, glm::dvec3(2, 2, -2));
  EXPECT_EQ(model.nodes[1].light, 0);
  ASSERT_TRUE(model.nodes[2].matrix.has_value());
  EXPECT_EQ((*model.nodes[2].matrix)[3], glm::dvec4(4, 5, 6, 1));
  EXPECT_EQ(model.scene, 1);
  EXPECT_EQ(model.scenes.at(1).name, "second");
  EXPECT_EQ(model.scenes[0].roots, std::vector<int>{0});
}

TEST(Gltf, ChecksTheRangeOfLights) {
  const auto read = [](const GltfJson& light) {
    GltfBuilder file;
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::array({light});
    return file.read();
  };
  EXPECT_TRUE(read({{"type", "point"}}).warnings.empty());
  EXPECT_TRUE(read({{"type", "point"}, {"range", 1e-9}}).warnings.empty());
  const Model zero = read({{"type", "point"}, {"range", 0}});
  EXPECT_EQ(zero.lights.at(0).range, 0.0) << "unlimited";
  ASSERT_EQ(zero.warnings.size(), 1u);
  EXPECT_NE(zero.warnings[0].find("lights[0].range: 0 is out of range"), std::string::npos) << zero.warnings[0];
  for (const GltfJson& range : {GltfJson(-1), GltfJson("1"), GltfJson(1e39), GltfJson(nullptr)})
    EXPECT_THROW(read({{"type", "spot"}, {"range", range}}), InputError) << range;
}

TEST(Gltf, ReadsAnimations) {
  GltfBuilder file;
  file.add("nodes", GltfJson::object());
  const int times = file.accessor<float>({0.5f, 2.0f}, 1);
  const int moves = file.accessor<float>({1, 2, 3, 4, 5, 6}, 3), turns = file.accessor<int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, 4, true);
  const int splines = file.accessor<float>(std::vector<float>(18, 1.0f), 3);
  file.add("animations", {{"name", "walk"},
                          {"samplers",
                           {{{"input", times}, {"output", moves}},
                            {{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
                            {{"input", times}, {"output", splines}, {"interpolation", "CUBICSPLINE"}}}},
                          {"channels",
                           {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                            {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}},
                            {{"sampler", 2}, {"target", {{"node", 0}, {"path", "scale"}}}},
                            {{"sampler", 0}, {"target", {{"path", "translation"}}}},
                            {{"sampler", 0}, {"target", {{"path", "pointer"}}}}}}});
  const Model model = file.read();
  const ModelAnimation& animation = model.animations.at(0);
  EXPECT_EQ(animation.name, "walk");
  ASSERT_EQ(animation.channels.size(), 3u);
  EXPECT_EQ(animation.channels[0].times, (std::vector<float>{0.5f, 2.0f}));
  EXPECT_EQ(animation.channels[0].interpolation, KeyInterpolation::linear);
  EXPECT_EQ(animation.channels[1].property, AnimatedProperty::rotation);
  EXPECT_EQ(animation.channels[1].values[6], 1.0f);
  EXPECT_EQ(animation.channels[1].width, 4);
  EXPECT_EQ(animation.channels[2].interpolation, KeyInterpolation::cubic);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("'pointer'"), std::string::npos);
}

TEST(Gltf, ReadsVisibilityAndPointersToNodes) {
  GltfBuilder file;
  file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"KHR_node_visibility", "KHR_animation_pointer"};
  const auto node = [](GltfJson visibility) { return GltfJson{{"extensions", {{"KHR_node_visibility", std::move(visibility)}}}}; };
  file.add("nodes", node({{"visible", false}}));
  file.add("nodes", node(GltfJson::object()));
  const int times = file.accessor<float>({0, 1}, 1), flags = file.accessor<uint8_t>({0, 7}, 1);
  const int moves = file.accessor<float>({1, 2, 3, 4, 5, 6}, 3);
  const auto channel = [](int sampler, const char* pointer) {
    const GltfJson extensions = {{"KHR_animation_pointer", {{"pointer", pointer}}}};
    return GltfJson{{"sampler", sampler}, {"target", {{"path", "pointer"}, {"extensions", extensions}}}};
  };
  file.add("animations", {{"samplers", {{{"input", times}, {"output", flags}}, {{"input", times}, {"output", moves}}}},
                          {"channels",
                           {channel(0, "/nodes/1/extensions/KHR_node_visibility/visible"), channel(1, "/nodes/0/translation"),
                            channel(1, "/materials/0/emissiveFactor"), channel(1, "/nodes/2/translation")}}});
  const Model model = file.read();
  EXPECT_FALSE(model.nodes.at(0).visible);
  EXPECT_TRUE(model.nodes.at(1).visible);
  const std::vector<AnimationChannel>& channels = model.animations.at(0).channels;
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].property, AnimatedProperty::visibility);
  EXPECT_EQ(channels[0].interpolation, KeyInterpolation::step);
  EXPECT_EQ(channels[0].node, 1);
  EXPECT_EQ(channels[0].values, (std::vector<float>{0, 7}));
  EXPECT_EQ(channels[1].property, AnimatedProperty::translation);
  EXPECT_EQ(channels[1].node, 0);
  ASSERT_EQ(model.warnings.size(), 2u);
  EXPECT_NE(model.warnings[0].find("/materials/0/emissiveFactor"), std::string::npos);
  EXPECT_NE(model.warnings[1].find("/nodes/2/translation"), std::string::npos);
}

TEST(Gltf, ReadsGlbAndExternalBuffers) {
  GltfBuilder file;
  file.mesh_node({{"attributes", {{"POSITION", file.triangle()}}}});
  const std::string glb = file.glb();
  EXPECT_TRUE(is_glb(std::as_bytes(std::span(glb))));
  EXPECT_EQ(GltfBuilder::read_text(glb).meshes.at(0).positions[1], glm::vec3(1, 0, 0));
  const TemporaryFolder folder;
  const std::vector<float> positions = {5, 0, 0, 1, 0, 0, 0, 1, 0};
  write_bytes(folder.path() / "a b.bin", {reinterpret_cast<const char*>(positions.data()), 36});
  GltfJson json = file.finished();
  json["buffers"][0]["uri"] = "a%20b.bin";
  const Model model = GltfBuilder::read_text(json.dump(), {}, folder.path() / "a.gltf");
  EXPECT_EQ(model.meshes.at(0).positions[0], glm::vec3(5, 0, 0));
}

// Adds a buffer view of `count` elements, compressed with meshoptimizer.
int compressed_view(GltfBuilder& file, const std::vector<unsigned char>& encoded, std::size_t count, std::size_t stride, const char* mode,
                    const char* filter) {
  GltfJson view = file.json["bufferViews"][static_cast<std::size_t>(file.view(encoded))];
  view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", view["byteOffset"]},
                                                   {"byteLength", view["byteLength"]},
                                                   {"byteStride", stride},
                                                   {"count", count},
                                                   {"mode", mode},
                                                   {"filter", filter}};
  view["byteLength"] = count * stride;
  return file.add("bufferViews", view);
}

TEST(Gltf, DecompressesMeshopt) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f};
  const std::vector<unsigned> indices = {0, 1, 2, 2, 1, 3};
  const std::vector<float> normals = {0, 0, 1, 0, 1, 0, 0, 0, 0.6f, 0, 0.8f, 0, -1, 0, 0, 0};
  meshopt_encodeVertexVersion(0);
  meshopt_encodeIndexVersion(1);
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12)), triangles(meshopt_encodeIndexBufferBound(6, 4)),
      sequence(meshopt_encodeIndexSequenceBound(6, 4)), octahedral(meshopt_encodeVertexBufferBound(4, 4));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 4, 12));
  triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), 6));
  sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), indices.data(), 6));
  std::vector<int8_t> filtered(16);
  meshopt_encodeFilterOct(filtered.data(), 4, 4, 8, normals.data());
  octahedral.resize(meshopt_encodeVertexBuffer(octahedral.data(), octahedral.size(), filtered.data(), 4, 4));
  for (const bool as_sequence : {false, true}) {
    GltfBuilder file;
    const int p = compressed_view(file, vertices, 4, 12, "ATTRIBUTES", "NONE");
    const int n = compressed_view(file, octahedral, 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
    const int i = as_sequence ? compressed_view(file, sequence, 6, 4, "INDICES", "NONE")
                              : compressed_view(file, triangles, 6, 4, "TRIANGLES", "NONE");
    const int pa = file.add("accessors", {{"bufferView", p}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    const int na =
        file.add("accessors", {{"bufferView", n}, {"componentType", 5120}, {"count", 4}, {"type", "VEC3"}, {"normalized", true}});
    const int ia = file.add("accessors", {{"bufferView", i}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}});
    file.mesh_node({{"attributes", {{"POSITION", pa}, {"NORMAL", na}}}, {"indices", ia}});
    const ModelMesh mesh = file.read().meshes.at(0);
    EXPECT_EQ(mesh.positions[3], glm::vec3(1, 1, 0.5f));
    EXPECT_NEAR(mesh.normals[2].x, 0.6f, 0.01f);
    EXPECT_NEAR(mesh.normals[3].x, -1.0f, 0.01f);
    // The encoder may rotate the vertices of a triangle.
    for (std::size_t t = 0; t < 6; t += 3) {
      Indices corners(mesh.indices.begin() + static_cast<std::ptrdiff_t>(t), mesh.indices.begin() + static_cast<std::ptrdiff_t>(t) + 3);
      while (corners[0] != indices[t]) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      EXPECT_EQ(corners, (Indices{indices[t], indices[t + 1], indices[t + 2]}));
    }
  }
}

TEST(Gltf, ReplacesBadNormalsAndTextureCoordinates) {
  GltfBuilder file;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int n = file.accessor<float>({0, 0, 0, nan, 0, 0, 0, 0, 5}, 3), uv = file.accessor<float>({nan, 0, 1, 1, 0, 1}, 2);
  file.mesh_node({{"attributes", {{"POSITION", file.triangle()}, {"NORMAL", n}, {"TEXCOORD_0", uv}}}});
  const Model model = file.read();
  EXPECT_EQ(model.meshes[0].normals, (std::vector<glm::vec3>(3, {0, 0, 1}))) << "computed from the triangle";
  EXPECT_EQ(model.meshes[0].uvs[0][0], glm::vec2(0.0f));
  EXPECT_EQ(model.warnings.size(), 2u);
}

// Four vertices of two triangles; vertex 1 or its color is not finite.
TEST(Gltf, SkipsPrimitivesWithPositionsThatAreNotFinite) {
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    for (const int mode : {0, 1, 4}) {
      GltfBuilder file;
      const int p = file.accessor<float>({0, 0, 0, 1, x, 0, 0, 1, 0, 2, 0, 0}, 3);
      const int c = file.accessor<float>({1, 0, 0, 1, 0, 0, x, 0, 0, 1, 0, 0}, 3);
      const std::vector<uint16_t> lists[] = {{0, 1, 2, 3}, {0, 1, 2, 3}, {}, {}, {0, 1, 2, 0, 3, 2}};
      const int indices = file.accessor<uint16_t>(lists[mode], 1);
      file.mesh_node({{"attributes", {{"POSITION", p}, {"COLOR_0", c}}}, {"indices", indices}, {"mode", mode}});
      const Model model = file.read();
      const ModelMesh& mesh = model.meshes.at(0);
      EXPECT_EQ(mesh.positions.size(), mode == 1 ? 2u : 3u) << mode;
      EXPECT_EQ(mesh.indices.size(), mode == 1 ? 2u : 3u) << mode;
      EXPECT_EQ(std::ranges::count(mesh.colors, glm::vec4(1.0f)), 1) << "replaced by white";
      EXPECT_EQ(model.warnings.size(), 2u);
      EXPECT_LE(pose(model, {}).high.x, 2.0);
    }
    GltfBuilder file;
    file.mesh_node({{"attributes", {{"POSITION", file.accessor<float>({x, 0, 0, 1, 0, 0, 0, 1, 0}, 3)}}}});
    const Model model = file.read();
    EXPECT_TRUE(model.meshes.empty());
    EXPECT_EQ(model.warnings.size(), 1u);
  }
}

// Also if there are more indices than vertices, and at the end of a list without indices.
TEST(Gltf, IgnoresVerticesThatNoTriangleUses) {
  for (const bool repeated : {false, true}) {
    GltfBuilder file;
    const int p = file.accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    const int indices = file.accessor<uint16_t>(repeated ? std::vector<uint16_t>{1, 2, 3, 1, 3, 2} : std::vector<uint16_t>{1, 2, 3}, 1);
    file.mesh_node({{"attributes", {{"POSITION", p}}}, {"indices", indices}});
    EXPECT_EQ(pose(file.read(), {}).high, glm::dvec3(1, 1, 0)) << repeated;
  }
  GltfBuilder file;
  file.mesh_node({{"attributes", {{"POSITION", file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}, 3)}}}});
  EXPECT_EQ(pose(file.read(), {}).high, glm::dvec3(1, 1, 0));
}

TEST(Gltf, ReportsUnsupportedExtensions) {
  GltfBuilder file;
  file.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_iridescence", "KHR_implicit_shapes"};
  file.json["extensionsRequired"] = {"KHR_materials_iridescence"};  // changes only appearance
  const Model model = file.read();
  EXPECT_EQ(model.extensions.size(), 3u);
  ASSERT_EQ(model.warnings.size(), 2u);
  EXPECT_NE(model.warnings[0].find("KHR_materials_iridescence"), std::string::npos);
  EXPECT_NE(model.warnings[1].find("KHR_implicit_shapes"), std::string::npos);
  file.json["extensionsRequired"] = {"KHR_implicit_shapes"};
  EXPECT_THROW(file.read(), InputError);
}

}  // namespace
}  // namespace halfspace
