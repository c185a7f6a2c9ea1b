// SPDX-License-Identifier: Apache-2.0
//
// Writes seeds for the fuzz targets with the exporter of Halfspace: a model with every kind of data, in every format.
//
//   fuzz-seeds FOLDER    writes to FOLDER/FORMAT (obj, mtl, gltf, ply, stl)
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "halfspace/model/write_model.h"
#include "support/files.h"

namespace halfspace {
namespace {

// Materials with every factor, and textures that refer to bytes in the model.
void add_materials(Model& model) {
  constexpr std::string_view kPng("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  const auto* const begin = reinterpret_cast<const std::byte*>(kPng.data());
  model.images.push_back({"color", {}, std::make_shared<std::vector<std::byte>>(begin, begin + kPng.size())});
  model.textures.push_back({0, {}});
  ModelMaterial& rich = model.materials.emplace_back();
  rich.name = "rich";
  rich.base_color = {0.5f, 0.25f, 1.0f, 0.75f};
  rich.base_color_map.texture = rich.normal_map.texture = rich.emissive_map.texture = 0;
  rich.base_color_map.uv_transform = {{2, 0}, {0, 2}, {0.5f, 0.5f}};
  rich.alpha_mode = AlphaMode::blend;
  rich.metallic = 0.5f;
  rich.roughness = 0.25f;
  rich.specular = 0.5f;
  rich.clearcoat = 1.0f;
  rich.sheen = 0.5f;
  rich.emissive = {0.0f, 4.0f, 0.0f};
  rich.double_sided = true;
  ModelMaterial& masked = model.materials.emplace_back();
  masked.name = "masked";
  masked.alpha_mode = AlphaMode::mask;
  masked.base_color_map.texture = 0;
  masked.unlit = true;
}

// A tetrahedron with all attributes; deformed by a morph target and a skin if `deforms`.
ModelMesh tetrahedron(bool deforms, int material) {
  ModelMesh mesh;
  mesh.name = deforms ? "deformed" : "static";
  mesh.origin = {100.0, 0.0, 0.0};
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.normals = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tangents.assign(4, {0, 1, 0, -1});
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  mesh.uvs[1] = mesh.uvs[0];
  mesh.colors.assign(4, {1, 0.5f, 0.25f, 1});
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  mesh.material = material;
  if (deforms) {
    mesh.targets.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, mesh.normals, {}});
    mesh.joints = {{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}};
    mesh.weights = {{0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
  }
  return mesh;
}

void add_nodes(Model& model) {
  model.nodes.resize(5);
  model.nodes[0] = {.name = "root", .children = {1, 2, 3}};
  model.nodes[1] = {.name = "deformed", .meshes = {0}, .skin = 0, .morph_weights = {0.5f}};
  model.nodes[2] = {.name = "static", .transform = {.scale = {-1, 1, 1}}, .meshes = {1}, .instances = {{}, {.translation = {2, 0, 0}}}};
  model.nodes[3] = {.name = "joint", .children = {4}};
  model.nodes[4] = {.name = "end", .camera = 0, .light = 0};
  model.skins.push_back({{3, 4}, {glm::dmat4(1.0), glm::dmat4(1.0)}});
  model.cameras.emplace_back().name = "camera";
  model.lights.push_back({.name = "spot", .type = ModelLightType::spot, .intensity = 100.0, .range = 10.0});
  model.scenes.push_back({"scene", {0}});
}

void add_animation(Model& model) {
  const std::vector<float> times = {0.0f, 1.0f};
  ModelAnimation& animation = model.animations.emplace_back();
  animation.name = "all properties";
  animation.channels = {
      {4, AnimatedProperty::translation, KeyInterpolation::linear, times, {0, 0, 0, 1, 1, 1}, 3},
      {3, AnimatedProperty::rotation, KeyInterpolation::linear, times, {0, 0, 0, 1, 0, 1, 0, 0}, 4},
      {2, AnimatedProperty::scale, KeyInterpolation::cubic, times, {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}, 3},
      {1, AnimatedProperty::weights, KeyInterpolation::step, times, {0, 1}, 1}};
}

Model rich_model() {
  Model model;
  add_materials(model);
  model.meshes = {tetrahedron(true, 0), tetrahedron(false, 1)};
  add_nodes(model);
  add_animation(model);
  return model;
}

void write(const Model& model, const std::filesystem::path& folder, const std::string& name, ModelFormat format) {
  for (const ModelFile& file : written_model(model, name, format).files) {
    std::filesystem::path extension = std::filesystem::path(file.name).extension();
    if (extension == ".glb") extension = ".gltf";
    if (extension == ".png" || extension == ".bin") continue;
    const std::filesystem::path target = folder / extension.string().substr(1);
    std::filesystem::create_directories(target);
    write_bytes(target / ("exported-" + file.name), {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
  }
}

}  // namespace
}  // namespace halfspace

int main(int argc, char** argv) {
  using halfspace::ModelFormat;
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz-seeds FOLDER\n");
    return 2;
  }
  const halfspace::Model model = halfspace::rich_model();
  halfspace::write(model, argv[1], "rich.glb", ModelFormat::glb);
  halfspace::write(model, argv[1], "rich.obj", ModelFormat::obj);
  halfspace::write(model, argv[1], "rich.ply", ModelFormat::ply);
  halfspace::write(model, argv[1], "rich.stl", ModelFormat::stl);
}
