// SPDX-License-Identifier: Apache-2.0
//
// Round trips: models are written and read back.
#include "halfspace/model/write_model.h"

#include <gtest/gtest.h>

#include <numbers>

#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/model/stl/read_stl.h"
#include "model/gltf_builder.h"
#include "model/obj_reading.h"
#include "model/ply_text.h"
#include "model/test_meshes.h"
#include "support/errors.h"

namespace halfspace {
namespace {

void expect_same(const TextureUse& a, const TextureUse& b, const std::string& what) {
  EXPECT_EQ(a.texture, b.texture) << what;
  if (a.texture < 0) return;
  EXPECT_EQ(a.uv_set, b.uv_set) << what;
  EXPECT_EQ(a.uv_transform, b.uv_transform) << what;
  EXPECT_EQ(a.channel, b.channel) << what;
}

void expect_same(const ModelMaterial& a, const ModelMaterial& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.base_color, b.base_color);
  EXPECT_EQ(a.alpha_mode, b.alpha_mode);
  EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
  EXPECT_EQ(a.metallic, b.metallic);
  EXPECT_EQ(a.roughness, b.roughness);
  EXPECT_EQ(a.specular, b.specular);
  EXPECT_EQ(a.specular_color, b.specular_color);
  EXPECT_EQ(a.ior, b.ior);
  EXPECT_EQ(a.clearcoat, b.clearcoat);
  EXPECT_EQ(a.clearcoat_roughness, b.clearcoat_roughness);
  EXPECT_EQ(a.clearcoat_normal_scale, b.clearcoat_normal_scale);
  EXPECT_EQ(a.sheen, b.sheen);
  EXPECT_EQ(a.sheen_color, b.sheen_color);
  EXPECT_EQ(a.sheen_roughness, b.sheen_roughness);
  EXPECT_EQ(a.normal_scale, b.normal_scale);
  EXPECT_EQ(a.occlusion_strength, b.occlusion_strength);
  EXPECT_EQ(a.emissive, b.emissive);
  EXPECT_EQ(a.unlit, b.unlit);
  EXPECT_EQ(a.double_sided, b.double_sided);
  expect_same(a.base_color_map, b.base_color_map, "base color");
  expect_same(a.metallic_map, b.metallic_map, "metallic");
  expect_same(a.roughness_map, b.roughness_map, "roughness");
  expect_same(a.specular_map, b.specular_map, "specular");
  expect_same(a.specular_color_map, b.specular_color_map, "specular color");
  expect_same(a.clearcoat_map, b.clearcoat_map, "clearcoat");
  expect_same(a.clearcoat_roughness_map, b.clearcoat_roughness_map, "clearcoat roughness");
  expect_same(a.clearcoat_normal_map, b.clearcoat_normal_map, "clearcoat normal");
  expect_same(a.sheen_color_map, b.sheen_color_map, "sheen color");
  expect_same(a.sheen_roughness_map, b.sheen_roughness_map, "sheen roughness");
  expect_same(a.normal_map, b.normal_map, "normal");
  expect_same(a.occlusion_map, b.occlusion_map, "occlusion");
  expect_same(a.emissive_map, b.emissive_map, "emissive");
}

void expect_same(const ModelMesh& a, const ModelMesh& b) {
  EXPECT_EQ(a.topology, b.topology);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.tangents, b.tangents);
  EXPECT_EQ(a.uvs[0], b.uvs[0]);
  EXPECT_EQ(a.uvs[1], b.uvs[1]);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.variant_materials, b.variant_materials);
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.more_joints, b.more_joints);
  EXPECT_EQ(a.more_weights, b.more_weights);
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (std::size_t i = 0; i < a.targets.size(); ++i) {
    EXPECT_EQ(a.targets[i].positions, b.targets[i].positions);
    EXPECT_EQ(a.targets[i].normals, b.targets[i].normals);
    EXPECT_EQ(a.targets[i].tangents, b.targets[i].tangents);
  }
}

void expect_same(const NodeTransform& a, const NodeTransform& b) {
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.scale, b.scale);
}

void expect_same(const ModelNode& a, const ModelNode& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.matrix, b.matrix);
  expect_same(a.transform, b.transform);
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.meshes, b.meshes);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(a.morph_weights, b.morph_weights);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) expect_same(a.instances[i], b.instances[i]);
}

void expect_same(const AnimationChannel& a, const AnimationChannel& b) {
  EXPECT_EQ(a.node, b.node);
  EXPECT_EQ(a.property, b.property);
  EXPECT_EQ(a.interpolation, b.interpolation);
  EXPECT_EQ(a.times, b.times);
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.width, b.width);
}

void expect_same(const ModelCamera& a, const ModelCamera& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.perspective, b.perspective);
  EXPECT_EQ(a.perspective ? a.fovy : a.height, a.perspective ? b.fovy : b.height);
  EXPECT_EQ(a.near, b.near);
  EXPECT_EQ(a.far, b.far);
}

void expect_same(const ModelLight& a, const ModelLight& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.inner, b.inner);
  EXPECT_EQ(a.outer, b.outer);
}

template <class T>
void expect_same_lists(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(a[i], b[i]);
  }
}

// Compares everything except the format and the warnings.
void expect_same(const Model& a, const Model& b) {
  expect_same_lists(a.materials, b.materials);
  expect_same_lists(a.meshes, b.meshes);
  expect_same_lists(a.nodes, b.nodes);
  expect_same_lists(a.cameras, b.cameras);
  expect_same_lists(a.lights, b.lights);
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    EXPECT_EQ(a.images[i].name, b.images[i].name);
    ASSERT_NE(b.images[i].bytes, nullptr);
    EXPECT_EQ(*a.images[i].bytes, *b.images[i].bytes);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].image, b.textures[i].image);
    EXPECT_EQ(a.textures[i].sampler.mag, b.textures[i].sampler.mag);
    EXPECT_EQ(a.textures[i].sampler.min, b.textures[i].sampler.min);
    EXPECT_EQ(a.textures[i].sampler.wrap_s, b.textures[i].sampler.wrap_s);
    EXPECT_EQ(a.textures[i].sampler.wrap_t, b.textures[i].sampler.wrap_t);
  }
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (std::size_t i = 0; i < a.skins.size(); ++i) {
    EXPECT_EQ(a.skins[i].joints, b.skins[i].joints);
    EXPECT_EQ(a.skins[i].joint_from_mesh, b.skins[i].joint_from_mesh);
  }
  ASSERT_EQ(a.animations.size(), b.animations.size());
  for (std::size_t i = 0; i < a.animations.size(); ++i) expect_same_lists(a.animations[i].channels, b.animations[i].channels);
  ASSERT_EQ(a.scenes.size(), b.scenes.size());
  for (std::size_t i = 0; i < a.scenes.size(); ++i) EXPECT_EQ(a.scenes[i].roots, b.scenes[i].roots);
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.variants, b.variants);
}

std::shared_ptr<const std::vector<std::byte>> bytes_of(std::string_view text) {
  const auto all = std::as_bytes(std::span(text));
  return std::make_shared<const std::vector<std::byte>>(all.begin(), all.end());
}

ModelMesh lit_cube() {
  ModelMesh mesh = cube();
  add_flat_normals(mesh);
  const std::size_t n = mesh.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<float>(i);
    mesh.tangents.emplace_back(0.0f, 0.6f, 0.8f, i % 2 == 0 ? 1.0f : -1.0f);
    mesh.uvs[0].emplace_back(0.1f * x, 1.7f - 0.3f * x);
    mesh.uvs[1].emplace_back(0.7f, -0.1f * x);
    mesh.colors.emplace_back(0.1f, 0.2f, x / 40.0f, 0.9f);
  }
  return mesh;
}

TextureUse use_of(int texture, Channel channel = Channel::red) {
  TextureUse use;
  use.texture = texture;
  use.channel = channel;
  return use;
}

ModelMaterial rich_material() {
  ModelMaterial m;
  m.name = "rich \"quoted\"";
  m.base_color = {0.1f, 0.2f, 0.3f, 0.4f};
  m.base_color_map = use_of(0);
  m.base_color_map.uv_set = 1;
  m.base_color_map.uv_transform = {{2.5f, 0.0f}, {0.0f, 0.3f}, {0.1f, -0.7f}};
  m.alpha_mode = AlphaMode::mask;
  m.alpha_cutoff = 0.3f;
  m.metallic = 0.7f;
  m.roughness = 0.35f;
  m.metallic_map = use_of(1, Channel::blue);
  m.roughness_map = use_of(1, Channel::green);
  m.specular = 0.9f;
  m.specular_color = {1.5f, 0.2f, 0.7f};
  m.specular_map = use_of(1, Channel::alpha);
  m.specular_color_map = use_of(0);
  m.ior = 1.33f;
  m.clearcoat = 0.8f;
  m.clearcoat_roughness = 0.15f;
  m.clearcoat_map = use_of(0, Channel::red);
  m.clearcoat_roughness_map = use_of(0, Channel::green);
  m.clearcoat_normal_map = use_of(1);
  m.clearcoat_normal_scale = 0.3f;
  m.sheen = 1.0f;  // the reader of glTF returns 1 or 0
  m.sheen_color = {0.9f, 0.4f, 0.2f};
  m.sheen_roughness = 0.55f;
  m.sheen_color_map = use_of(0);
  m.sheen_roughness_map = use_of(1, Channel::alpha);
  m.normal_map = use_of(1);
  m.normal_scale = 0.6f;
  m.occlusion_map = use_of(1, Channel::red);
  m.occlusion_strength = 0.45f;
  m.emissive = {3.1f, 0.2f, 17.3f};
  m.emissive_map = use_of(0);
  m.double_sided = true;
  return m;
}

// A model that uses everything that glTF can store.
Model rich_model() {
  Model model;
  model.images = {{"wood", {}, bytes_of("\x89PNG\r\n\x1a\n not decoded")}, {"stone", {}, bytes_of("\xff\xd8\xff not decoded")}};
  model.textures = {{0, {}}, {1, {}}};
  model.textures[0].sampler = {Filter::nearest, Filter::bilinear, Wrap::clamp, Wrap::mirrored};
  ModelMaterial plain;
  plain.name = "plain";
  plain.unlit = true;
  plain.alpha_mode = AlphaMode::blend;
  model.materials = {rich_material(), plain};
  model.variants = {"a", "b"};
  ModelMesh first = lit_cube(), second = lit_cube(), points, skinned = lit_cube();
  first.material = 0;
  first.variant_materials = {0, 1};
  second.material = 1;
  second.targets.push_back({second.positions, second.normals, second.normals});
  second.targets.push_back({second.normals, {}, {}});
  points.topology = MeshTopology::points;
  points.positions = {{1, 2, 3}, {4, 5, 6}};
  points.material = 1;
  skinned.material = 0;
  skinned.joints.assign(skinned.positions.size(), {1, 0, 0, 0});
  skinned.weights.assign(skinned.positions.size(), {0.25f, 0.5f, 0.0f, 0.0f});
  skinned.more_joints.assign(skinned.positions.size(), {0, 1, 0, 0});
  skinned.more_weights.assign(skinned.positions.size(), {0.0f, 0.25f, 0.0f, 0.0f});
  model.meshes = {first, points, second, skinned};
  model.nodes.resize(7);
  model.nodes[0].name = "root";
  model.nodes[0].transform = {{0.1, 1e7 + 0.3, -3.0}, {0.5, 0.5, 0.5, -0.5}, {1.0, -2.0, 0.3}};
  model.nodes[0].children = {1, 2, 3};
  model.nodes[1].meshes = {0, 1};
  model.nodes[1].matrix = glm::dmat4({0.1, 2, 0, 0}, {3, 1, 7, 0}, {0, 0.3, 1, 0}, {0, 5, 0, 1});
  model.nodes[1].instances = {{{1, 2, 3}, {1, 0, 0, 0}, {1, 1, 1}}, {{-1, 0, 0.5}, {0.5, -0.5, 0.5, 0.5}, {2, 3, 0.25}}};
  model.nodes[2].meshes = {2};
  model.nodes[2].morph_weights = {0.25f, 0.7f};
  model.nodes[3].camera = 0;
  model.nodes[3].light = 1;
  model.nodes[4].meshes = {3};
  model.nodes[4].skin = 0;
  model.nodes[5].children = {6};
  model.nodes[6].camera = 1;
  model.nodes[6].light = 0;
  model.skins.push_back({{5, 6}, {glm::dmat4(1.0), glm::dmat4({0.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1})}});
  model.cameras.resize(2);
  model.cameras[0] = {"eye", true, 0.77, 2.0, 0.01, std::numeric_limits<double>::infinity()};
  model.cameras[1] = {"plan", false, 0.8, 5.5, 0.1, 99.0};
  model.lights.resize(2);
  model.lights[0] = {"sun", ModelLightType::directional, {1.0f, 0.9f, 0.1f}, 3.7, 0.0, 0.0, std::numbers::pi / 4.0};
  model.lights[1] = {"lamp", ModelLightType::spot, {0.5f, 0.9f, 0.1f}, 100.1, 7.5, 0.2, 0.6};
  model.scenes = {{"all", {0, 4, 5}}, {"none", {}}};
  ModelAnimation walk;
  walk.name = "walk";
  walk.channels = {{0, AnimatedProperty::translation, KeyInterpolation::step, {0.1f, 0.7f}, {1, 2, 3, 4, 5, 6}, 3},
                   {5, AnimatedProperty::rotation, KeyInterpolation::linear, {0.0f, 1.5f}, {0, 0, 0, 1, 0, 1, 0, 0}, 4},
                   {2, AnimatedProperty::weights, KeyInterpolation::cubic, {0.5f}, {1, 2, 3, 4, 5, 6}, 2},
                   {6, AnimatedProperty::scale, KeyInterpolation::linear, {0.0f}, {1, 0.5f, 2}, 3}};
  model.animations = {walk};
  return model;
}

void expect_no_warnings(const Model& read) { EXPECT_TRUE(read.warnings.empty()) << read.warnings[0]; }

TEST(WriteModel, BinaryGltfReadsBackBitForBit) {
  const Model model = rich_model();
  const WrittenModel written = written_model(model, "folder/a model.glb", ModelFormat::glb);
  ASSERT_EQ(written.files.size(), 1u);
  EXPECT_EQ(written.files[0].name, "a model.glb");
  EXPECT_TRUE(written.warnings.empty()) << written.warnings[0];
  const Model read = read_gltf("/none/a.glb", written.files[0].bytes, {});
  expect_no_warnings(read);
  expect_same(model, read);
}

TEST(WriteModel, TextGltfRefersToItsFiles) {
  const TemporaryFolder folder;
  Model model = rich_model();
  const WrittenModel written = written_model(model, "a model.gltf", ModelFormat::gltf);
  ASSERT_EQ(written.files.size(), 4u);
  for (const ModelFile& file : written.files)
    write_bytes(folder.path() / file.name, {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
  Model read = read_model(folder.path() / "a model.gltf");
  expect_no_warnings(read);
  for (ModelImage& image : read.images) {
    const std::string bytes = read_bytes(image.file);
    image.bytes = bytes_of(bytes);
  }
  expect_same(model, read);
}

// Positions are stored relative to the origin of the mesh, which becomes the translation of a node.
TEST(WriteModel, GltfKeepsThePrecisionOfModelsFarFromTheOrigin) {
  Model model;
  ModelMesh mesh = lit_cube();
  mesh.origin = {5e6 + 0.1, -7.0, 0.3};
  model.meshes = {mesh};
  model.nodes.resize(1);
  model.nodes[0].meshes = {0};
  model.scenes = {{"", {0}}};
  model.up = UpAxis::z;
  const Model read = read_gltf("/none/a.glb", written_model(model, "a.glb", ModelFormat::glb).files[0].bytes, {});
  const PosedModel before = pose(model, {}), after = pose(read, {});
  ASSERT_EQ(after.meshes.size(), 1u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(after.low[axis], before.low[axis], 2e-9);
    EXPECT_NEAR(after.high[axis], before.high[axis], 2e-9);
  }
  EXPECT_EQ(read.meshes[0].positions, mesh.positions);
}

TEST(WriteModel, WarnsAboutWhatGltfCannotStore) {
  Model model = rich_model();
  model.materials[0].opacity_map = use_of(0);
  model.materials[0].roughness_map.channel = Channel::red;
  model.materials[0].sheen_map = use_of(0);
  model.images[1].bytes = bytes_of("GIF89a");
  const WrittenModel written = written_model(model, "a.glb", ModelFormat::glb);
  std::string all;
  for (const std::string& warning : written.warnings) all += warning + "\n";
  EXPECT_NE(all.find("opacity map"), std::string::npos) << all;
  EXPECT_NE(all.find("sheen map"), std::string::npos) << all;
  EXPECT_NE(all.find("'stone' is omitted"), std::string::npos) << all;
  expect_no_warnings(read_gltf("/none/a.glb", written.files[0].bytes, {}));
}

// Textures whose image is omitted are omitted too, and the materials refer to the remaining ones.
TEST(WriteModel, GltfHasNoTexturesWithoutImages) {
  Model model = rich_model();
  model.images[0].bytes = bytes_of("GIF89a");
  const Model read = read_gltf("/none/a.glb", written_model(model, "a.glb", ModelFormat::glb).files[0].bytes, {});
  EXPECT_EQ(model.textures.size(), 2u);
  ASSERT_EQ(read.textures.size(), 1u);
  EXPECT_EQ(read.textures[0].image, 0);
  EXPECT_EQ(read.images.at(0).name, "stone");
  EXPECT_EQ(read.materials.at(0).base_color_map.texture, -1);
  EXPECT_EQ(read.materials.at(0).normal_map.texture, 0);
}

// In glTF, only point and spot lights have one.
TEST(WriteModel, DirectionalLightsHaveNoRange) {
  Model model = rich_model();
  model.lights = {{.name = "sun", .range = 5.0}, {.name = "lamp", .type = ModelLightType::point, .range = 5.0}};
  for (ModelNode& node : model.nodes) node.light = std::min(node.light, 1);
  const Model read = read_gltf("/none/a.glb", written_model(model, "a.glb", ModelFormat::glb).files[0].bytes, {});
  ASSERT_EQ(read.lights.size(), 2u);
  EXPECT_EQ(read.lights[0].range, 0.0);
  EXPECT_EQ(read.lights[1].range, 5.0);
}

Model written_and_read(const Model& model, ModelFormat format) {
  const WrittenModel written = written_model(model, "a.x", format);
  const std::span<const std::byte> bytes = written.files[0].bytes;
  if (format == ModelFormat::ply) return read_ply("a.x", bytes, {});
  if (format == ModelFormat::stl) return read_stl("a.x", bytes, {});
  return read_obj("/none/a.x", bytes, {});
}

// The numbers are chosen so that the center of the bounds, which readers use as the origin, is exact.
TEST(WriteModel, PlyReadsBackBitForBit) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\n"
      "property float ny\nproperty float nz\nproperty double s\nproperty double t\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty uchar alpha\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
  text +=
      "0 0 0 0.1 0.2 0.3 0.1 0.9 1 2 3 255\n1000000.5 0 0 1 2 3 0.3 0.2 255 0 77 128\n0 1 0 0 0 1 0 0 9 8 7 1\n0 0 1 0.3 0 -1 1 1 0 0 0 "
      "0\n";
  text += "3 0 1 2\n3 2 1 3\n";
  const Model model = ply_model(text);
  Model read = written_and_read(model, ModelFormat::ply);
  expect_same_lists(model.meshes, read.meshes);
}

TEST(WriteModel, PointCloudsAreWrittenAsPly) {
  const Model model = ply_model(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 1 2\n3 4 5\n0.5 1.5 "
      "2.5\n");
  expect_same_lists(model.meshes, written_and_read(model, ModelFormat::ply).meshes);
}

TEST(WriteModel, StlReadsBackBitForBit) {
  std::string text = "solid a\n";
  for (const char* triangle : {"0 0 0 vertex 1.25 0 0 vertex 0 1.125 0", "0 0 3 vertex 0 1.125 0 vertex 1.25 0 0"})
    text += std::string("facet normal 0 0 1 outer loop vertex ") + triangle + " endloop endfacet\n";
  const Model model = read_stl("a.stl", std::as_bytes(std::span(text)), {});
  const Model read = written_and_read(model, ModelFormat::stl);
  expect_same_lists(model.meshes, read.meshes);
  EXPECT_EQ(read.up, UpAxis::z);
}

TEST(WriteModel, ObjReadsBackBitForBit) {
  const Model model = read_obj_text(
      "v -1.1 0 0.3\nv 1.1 0 -0.3\nv 0.1 0.7 0\nv 0.1 -0.7 0\nvn 0.1 0.2 0.3\nvn 0 0 1\nvt 0.625 0.1\nvt 0.75 0.3\nvt 0.5 1\n"
      "f 1/1/1 2/2/1 3/3/2\nf 1/1/1 3/3/2 4/2/1\nl 1 2 3\np 4\n");
  const Model read = written_and_read(model, ModelFormat::obj);
  expect_same_lists(model.meshes, read.meshes);
}

TEST(WriteModel, ObjMaterialsReadBack) {
  const TemporaryFolder folder;
  Model model =
      read_mtl_text(folder, "newmtl m\nKd 0.2 0.4 0.6\nNs 100\nKs 0.3 0.2 0.1\nd 0.5\nKe 0.1 0.2 3\nNi 1.4\nPs 0.375\nPc 0.7\nPcr 0.2\n");
  ModelMaterial metal;
  metal.name = "m 2";
  metal.metallic = 0.75f;
  metal.roughness = 0.3f;
  metal.double_sided = true;
  metal.sheen = 0.5f;
  metal.sheen_color = {0.25f, 0.75f, 0.5f};  // MTL stores only the largest component
  model.materials.push_back(metal);
  ModelMesh second = model.meshes[0];
  second.material = 1;
  model.meshes.push_back(second);
  model.nodes[0].meshes = {0, 1};
  const WrittenModel written = written_model(model, "b.obj", ModelFormat::obj);
  for (const ModelFile& file : written.files)
    write_bytes(folder.path() / file.name, {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
  const Model read = read_model(folder.path() / "b.obj");
  ASSERT_EQ(read.materials.size(), 2u);
  EXPECT_EQ(read.materials[1].name, "m_2");
  for (std::size_t i = 0; i < 2; ++i) {
    const ModelMaterial &a = model.materials[i], &b = read.materials[i];
    EXPECT_NEAR(a.roughness, b.roughness, 1e-5f);
    EXPECT_FLOAT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(a.base_color[k], b.base_color[k], 1e-6f);
      EXPECT_NEAR(a.emissive[k], b.emissive[k], 1e-5f);
      EXPECT_NEAR(a.specular_color[k], b.specular_color[k], 1e-6f);
    }
    EXPECT_EQ(a.base_color.w, b.base_color.w);
    EXPECT_EQ(a.ior, b.ior);
    EXPECT_EQ(a.clearcoat, b.clearcoat);
    EXPECT_EQ(a.clearcoat_roughness, b.clearcoat_roughness);
  }
  EXPECT_EQ(read.materials[0].sheen, 0.375f);
  EXPECT_EQ(read.materials[1].sheen, 0.375f);
  ASSERT_EQ(written.warnings.size(), 1u);
  EXPECT_NE(written.warnings[0].find("white sheen of roughness 0.5"), std::string::npos) << written.warnings[0];
}

TEST(WriteModel, RejectsModelsThatTheFormatCannotStore) {
  Model model;
  model.scenes.emplace_back();
  for (const ModelFormat format : {ModelFormat::obj, ModelFormat::ply, ModelFormat::stl})
    EXPECT_TRUE(reports(input_error([&] { written_model(model, "a.x", format); }), "a.", {"expected"}));
  EXPECT_EQ(written_model(model, "a.glb", ModelFormat::glb).files.size(), 1u);
}

TEST(WriteModel, FormatFollowsTheFileName) {
  EXPECT_EQ(model_format_of("a.GLB"), ModelFormat::glb);
  EXPECT_EQ(model_format_of("x/a.gltf"), ModelFormat::gltf);
  EXPECT_EQ(model_format_of("a.png"), std::nullopt);
}

}  // namespace
}  // namespace halfspace
