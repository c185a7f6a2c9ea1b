// SPDX-License-Identifier: Apache-2.0
//
// Model files: read once, shared by scenes, and readable as arrays.
#include <array>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>
#include <variant>

#include "bindings.h"
#include "halfspace/core/text.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/assets/texture_image.h"
#include "halfspace/render/export/embed_images.h"
#include "halfspace/render/export/pack_maps.h"

namespace halfspace::python {

namespace {

using Asset = std::shared_ptr<ModelAsset>;

// Reads a model file. up_axis: "y", "z" or empty for that of the file.
Asset load_model(const std::string& file, bool allow_outside, const std::string& up_axis) {
  Model model = read_model(file, {.allow_outside = allow_outside});
  if (!up_axis.empty()) model.up = up_axis == "z" ? UpAxis::z : UpAxis::y;
  return std::make_shared<ModelAsset>(std::move(model));  // all files are known
}

// Returns the model of one mesh with its place: a file with one node. The mesh keeps its material, with all textures.
Asset part_of(const Model& model, const PosedMesh& posed) {
  Model part;
  part.format = model.format;
  part.images = model.images;
  part.textures = model.textures;
  part.materials = {posed.material < 0 ? ModelMaterial{} : model.materials[static_cast<std::size_t>(posed.material)]};
  ModelMesh& mesh = part.meshes.emplace_back(posed.deformed ? *posed.deformed : model.meshes[static_cast<std::size_t>(posed.mesh)]);
  mesh.material = 0;
  mesh.variant_materials = {};
  mesh.targets = {};
  mesh.joints = mesh.more_joints = {};
  mesh.weights = mesh.more_weights = {};
  ModelNode& node = part.nodes.emplace_back();
  node.name = mesh.name;
  glm::dmat4 from_origin(1.0);  // world_from_mesh applies to positions without the origin
  from_origin[3] = glm::dvec4(-mesh.origin, 1.0);
  node.matrix = posed.world_from_mesh * from_origin;
  node.meshes = {0};
  part.scenes = {{"", {0}}};
  return std::make_shared<ModelAsset>(std::move(part));
}

template <class V>
py::object array_of_rows(const std::vector<V>& rows) {
  if (rows.empty()) return py::none();
  return py::array_t<typename V::value_type>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{V::length()}}, &rows.data()->x);
}

// Returns the positions of a part in the space of its model.
std::vector<glm::dvec3> positions_of(const Model& part) {
  std::vector<glm::dvec3> positions;
  for (const glm::vec3& p : part.meshes[0].positions)
    positions.emplace_back(*part.nodes[0].matrix * glm::dvec4(part.meshes[0].origin + glm::dvec3(p), 1.0));
  return positions;
}

// Returns the normals of a part in the space of its model.
std::vector<glm::vec3> normals_of(const Model& part) {
  const glm::dmat3 turn = glm::inverseTranspose(glm::dmat3(*part.nodes[0].matrix));
  std::vector<glm::vec3> normals;
  for (const glm::vec3& n : part.meshes[0].normals) normals.emplace_back(glm::normalize(turn * glm::dvec3(n)));
  return normals;
}

// Returns the indices of the vertices of triangles, lines or points. Mirrored triangles are turned round, so that their fronts stay fronts.
std::vector<uint32_t> indices_of(const Model& part) {
  const ModelMesh& mesh = part.meshes[0];
  std::vector<uint32_t> indices = mesh.indices;
  if (indices.empty()) {
    for (uint32_t i = 0; i < mesh.positions.size(); ++i) indices.push_back(i);
  }
  const bool mirrored = glm::determinant(glm::dmat3(*part.nodes[0].matrix)) < 0.0;
  for (std::size_t i = 0; mirrored && mesh.topology == MeshTopology::triangles && i + 2 < indices.size(); i += 3)
    std::swap(indices[i + 1], indices[i + 2]);
  return indices;
}

py::dict arrays_of(const Model& part) {
  const ModelMesh& mesh = part.meshes[0];
  const std::vector<uint32_t> indices = indices_of(part);
  py::dict arrays;
  arrays["topology"] = mesh.topology;
  arrays["vertices"] = array_of_rows(positions_of(part));
  arrays["normals"] = array_of_rows(normals_of(part));
  arrays["uvs"] = array_of_rows(mesh.uvs[0]);
  arrays["colors"] = array_of_rows(mesh.colors);
  arrays["faces"] = py::array_t<uint32_t>(static_cast<py::ssize_t>(indices.size()), indices.data());
  return arrays;
}

// Returns the texels, the filters, the wrap modes and the anisotropy of a texture, or None if there is none or it cannot be read. Texels
// with 8 bits are returned as they are, all others as numbers.
py::object texture_of(const Model& model, const ModelMaterial& m, TextureUse ModelMaterial::*map, const std::string& file) {
  const TextureUse& use = m.*map;
  const int number = use.texture < 0 ? -1 : model.textures[static_cast<std::size_t>(use.texture)].image;
  if (number < 0) return py::none();
  const ModelImage& image = model.images[static_cast<std::size_t>(number)];
  if (image.bytes == nullptr) return py::none();
  TextureImage texels;
  {
    const py::gil_scoped_release release;
    texels = texels_of(image, role_of(map), file);
  }
  const auto array = std::visit([](auto& t) -> py::array { return array_of(std::move(t)); }, texels);
  const Sampler& s = model.textures[static_cast<std::size_t>(use.texture)].sampler;
  return py::make_tuple(array, s.min, s.mag, s.wrap_s, s.wrap_t, s.anisotropy);
}

py::tuple color_of(const glm::vec3& c) { return py::make_tuple(c.x, c.y, c.z); }

// Returns the properties of a material whose maps have the channels of glTF, with the names of halfspace.Material.
py::dict properties_of(const Model& model, const ModelMaterial& m, const std::string& file) {
  using namespace py::literals;
  using M = ModelMaterial;
  const auto texture = [&](TextureUse M::*map) { return texture_of(model, m, map, file); };
  return py::dict("base_color"_a = py::make_tuple(m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w),
                  "metallic"_a = m.metallic, "roughness"_a = m.roughness, "specular"_a = m.specular, "ior"_a = m.ior,
                  "emissive"_a = color_of(m.emissive), "clearcoat"_a = m.clearcoat, "clearcoat_roughness"_a = m.clearcoat_roughness,
                  "sheen"_a = m.sheen, "sheen_roughness"_a = m.sheen_roughness, "alpha_mode"_a = m.alpha_mode,
                  "alpha_cutoff"_a = m.alpha_cutoff, "unlit"_a = m.unlit, "double_sided"_a = m.double_sided,
                  "normal_scale"_a = m.normal_scale, "occlusion_strength"_a = m.occlusion_strength,
                  "base_color_texture"_a = texture(&M::base_color_map),
                  "metallic_roughness_texture"_a = texture(m.metallic_map.texture >= 0 ? &M::metallic_map : &M::roughness_map),
                  "normal_texture"_a = texture(&M::normal_map), "occlusion_texture"_a = texture(&M::occlusion_map),
                  "emissive_texture"_a = texture(&M::emissive_map));
}

// Returns a tuple for each mesh that is drawn, in the pose of the file: its model, its arrays, and the number of its material.
py::list parts_of(const ModelAsset& asset) {
  py::list parts;
  for (const PosedMesh& posed : pose(asset.model, {.bounds = false}).meshes) {
    const Asset part = part_of(asset.model, posed);
    parts.append(py::make_tuple(part, arrays_of(part->model), posed.material));
  }
  return parts;
}

// Returns the properties of all materials, and then those of the default material.
py::list materials_of(const ModelAsset& asset, const std::string& file) {
  Model model = asset.model;
  {
    const py::gil_scoped_release release;
    embed_images(model, file);
    pack_maps(model, file);
  }
  py::list materials;
  model.materials.resize(asset.model.materials.size());  // without the copies that embed_images() made
  for (const ModelMaterial& m : model.materials) materials.append(properties_of(model, m, file));
  materials.append(properties_of(model, {}, file));
  return materials;
}

// Returns the bounds of all meshes that are drawn as an array of shape (2, 3), or None.
py::object bounds_of(const ModelAsset& asset) {
  const PosedModel posed = pose(asset.model, {});
  if (!(posed.low.x <= posed.high.x)) return py::none();
  const std::array box{posed.low, posed.high};
  return py::array_t<double>({py::ssize_t{2}, py::ssize_t{3}}, &box.front().x);
}

template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const T& item : list) names.push_back(printable(item.name));
  return names;
}

}  // namespace

void bind_model_file(py::module_& m) {
  m.def("load_model", &load_model, py::call_guard<py::gil_scoped_release>());
  m.def("model_parts", &parts_of);
  m.def("model_materials", &materials_of);
  m.def("model_bounds", &bounds_of);
  m.def("model_names", [](const ModelAsset& asset) {
    const Model& model = asset.model;
    return std::map<std::string, std::vector<std::string>>{
        {"animations", names_of(model.animations)}, {"variants", model.variants}, {"scenes", names_of(model.scenes)}};
  });
}

}  // namespace halfspace::python
