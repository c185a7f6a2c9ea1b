// SPDX-License-Identifier: Apache-2.0
//
// Writes models in formats that cannot store everything. Stored data reads back unchanged, and each kind of loss gives one warning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/write_model.h"
#include "model/gltf_builder.h"
#include "model/obj_reading.h"
#include "model/ply_text.h"
#include "model/test_meshes.h"

namespace halfspace {
namespace {

// Returns a model of one node that draws all meshes.
Model model_of(std::vector<ModelMesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  model.nodes.resize(1);
  for (std::size_t i = 0; i < model.meshes.size(); ++i) model.nodes[0].meshes.push_back(static_cast<int>(i));
  model.scenes = {{"", {0}}};
  return model;
}

ModelMesh cube_of(int material) {
  ModelMesh mesh = cube();
  add_flat_normals(mesh);
  mesh.material = material;
  return mesh;
}

ModelMesh primitives(MeshTopology topology) {
  ModelMesh mesh;
  mesh.topology = topology;
  mesh.positions = {{1, 2, 3}, {4, 5, 6}};
  if (topology == MeshTopology::lines) mesh.indices = {0, 1};
  return mesh;
}

// Adds an image that readers recognize by its first bytes, and a texture that uses it. Returns a reference to the texture.
TextureUse add_texture(Model& model) {
  const std::string_view text = "\x89PNG\r\n\x1a\n not decoded";
  const auto bytes = std::as_bytes(std::span(text));
  model.images.push_back({"image", {}, std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end())});
  model.textures.push_back({static_cast<int>(model.images.size()) - 1, {}});
  TextureUse use;
  use.texture = static_cast<int>(model.textures.size()) - 1;
  return use;
}

std::size_t warnings_with(const WrittenModel& written, std::string_view words) {
  return static_cast<std::size_t>(
      std::ranges::count_if(written.warnings, [&](const std::string& w) { return w.find(words) != std::string::npos; }));
}

Model read_in(const TemporaryFolder& folder, const WrittenModel& written) {
  for (const ModelFile& file : written.files)
    write_bytes(folder.path() / file.name, {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
  return read_model(folder.path() / written.files[0].name);
}

// `usemtl` stays in effect until the next one.
TEST(WriteLosses, ObjMeshesWithoutMaterialGetTheDefaultOne) {
  const TemporaryFolder folder;
  Model model = model_of({cube_of(0), cube_of(-1)});
  model.materials.resize(1);
  model.materials[0].name = "default";  // different from the name of the other material
  model.materials[0].base_color = {1.0f, 0.0f, 0.0f, 1.0f};
  const Model read = read_in(folder, written_model(model, "a.obj", ModelFormat::obj));
  ASSERT_EQ(read.meshes.size(), 2u);
  ASSERT_EQ(read.materials.size(), 2u);
  EXPECT_EQ(read.meshes[1].material, 1);
  EXPECT_EQ(read.materials[0].base_color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(read.materials[1].base_color, ModelMaterial{}.base_color);
  EXPECT_EQ(read.materials[1].roughness, ModelMaterial{}.roughness);
  EXPECT_TRUE(read.warnings.empty()) << read.warnings[0];
}

TEST(WriteLosses, ObjBumpMapsReadBack) {
  const TemporaryFolder folder;
  Model model = model_of({cube_of(0)});
  model.materials.resize(1);
  model.materials[0].bump_map = add_texture(model);
  model.materials[0].bump_scale = 0.07f;
  const WrittenModel written = written_model(model, "a.obj", ModelFormat::obj);
  EXPECT_TRUE(written.warnings.empty()) << written.warnings[0];
  const Model read = read_in(folder, written);
  EXPECT_GE(read.materials[0].bump_map.texture, 0);
  EXPECT_NEAR(read.materials[0].bump_scale, 0.07f, 1e-8f);  // two roundings to float
}

TEST(WriteLosses, ObjWarnsAboutMaterialLosses) {
  Model model = model_of({cube_of(0), cube_of(1)});
  model.meshes[0].colors.assign(model.meshes[0].positions.size(), glm::vec4(1.0f, 1.0f, 1.0f, 0.5f));
  model.materials.resize(2);
  for (ModelMaterial& m : model.materials) {
    m.base_color_map = m.normal_map = m.occlusion_map = add_texture(model);
    m.base_color_map.uv_transform = {{0.0f, 1.0f}, {-1.0f, 0.0f}, {0.0f, 0.0f}};
    m.normal_map.uv_set = 1;
    m.normal_scale = 0.5f;
  }
  const WrittenModel written = written_model(model, "a.obj", ModelFormat::obj);
  EXPECT_EQ(written.warnings.size(), 5u);
  for (const char* words :
       {"rotation", "one set of texture coordinates", "strength of normal maps", "occlusion", "opacity of vertex colors"})
    EXPECT_EQ(warnings_with(written, words), 1u) << words;
}

TEST(WriteLosses, PlyContainsOnlyTheSelectedPoints) {
  Model model = ply_model(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 1 2\n0.5 1.5 2.5\n");
  const std::vector<glm::vec3> positions = model.meshes[0].positions;
  model.meshes[0].positions.insert(model.meshes[0].positions.begin() + 1, glm::vec3(9.0f));
  model.meshes[0].indices = {0, 2};
  const WrittenModel written = written_model(model, "a.ply", ModelFormat::ply);
  const Model read = read_ply("a.ply", written.files[0].bytes, {});
  EXPECT_EQ(read.meshes[0].positions, positions);
  EXPECT_TRUE(read.warnings.empty());
}

TEST(WriteLosses, PlyAndStlWarnAboutOmittedPrimitives) {
  const Model all = model_of({cube_of(-1), primitives(MeshTopology::lines), primitives(MeshTopology::points)});
  const WrittenModel ply = written_model(all, "a.ply", ModelFormat::ply), stl = written_model(all, "a.stl", ModelFormat::stl);
  EXPECT_EQ(warnings_with(ply, "lines are omitted"), 1u);
  EXPECT_EQ(warnings_with(ply, "points are omitted"), 1u);
  EXPECT_EQ(warnings_with(stl, "lines and points are omitted"), 1u);
  const Model points = model_of({primitives(MeshTopology::points)}), triangles = model_of({cube_of(-1)});
  EXPECT_TRUE(written_model(points, "a.ply", ModelFormat::ply).warnings.empty());
  EXPECT_TRUE(written_model(triangles, "a.ply", ModelFormat::ply).warnings.empty());
  EXPECT_TRUE(written_model(triangles, "a.stl", ModelFormat::stl).warnings.empty());
}

TEST(WriteLosses, GltfOmitsEmptyMeshesAndTargets) {
  Model model = model_of({ModelMesh{}, cube_of(-1)});
  model.nodes.resize(2);
  model.nodes[1].meshes = {0};
  model.scenes[0].roots.push_back(1);
  model.animations.resize(1);
  model.animations[0].channels.resize(1);
  model.animations[0].channels[0].node = 0;
  const WrittenModel written = written_model(model, "a.glb", ModelFormat::glb);
  uint32_t length = 0;
  std::memcpy(&length, written.files[0].bytes.data() + 12, sizeof length);
  const GltfJson json = GltfJson::parse(std::string_view(reinterpret_cast<const char*>(written.files[0].bytes.data()) + 20, length));
  EXPECT_EQ(json.at("meshes").size(), 1u);
  EXPECT_FALSE(json.at("nodes")[1].contains("mesh"));
}

}  // namespace
}  // namespace halfspace
