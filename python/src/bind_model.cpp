// SPDX-License-Identifier: Apache-2.0
//
// Creates meshes from arrays, as model files in memory.
#include <memory>
#include <optional>

#include "bindings.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/render/assets/model_asset.h"
#include "images.h"

namespace halfspace::python {

namespace {

// The arrays of a mesh. All but the positions are optional.
struct MeshArrays {
  Array<double> positions;  ///< (N, 3)
  std::optional<Array<float>> normals, uvs, colors, tangents;
  std::optional<Array<uint32_t>> indices;
};

template <class T>
std::vector<T> copy_of(const std::optional<Array<float>>& array) {
  if (!array) return {};
  const std::span<const T> rows = rows_of<T>(*array);
  return {rows.begin(), rows.end()};
}

// In OpenGL, v = 0 is the bottom of the image; in models, it is the top.
std::vector<glm::vec2> flipped(std::vector<glm::vec2> uvs) {
  for (glm::vec2& uv : uvs) uv.y = 1.0f - uv.y;
  return uvs;
}

ModelMesh mesh_of(const MeshArrays& arrays, MeshTopology topology, bool flip_v) {
  ModelMesh mesh;
  mesh.topology = topology;
  set_positions(mesh, rows_of<glm::dvec3>(arrays.positions));
  mesh.normals = copy_of<glm::vec3>(arrays.normals);
  mesh.uvs[0] = copy_of<glm::vec2>(arrays.uvs);
  if (flip_v) mesh.uvs[0] = flipped(std::move(mesh.uvs[0]));
  mesh.colors = copy_of<glm::vec4>(arrays.colors);
  mesh.tangents = copy_of<glm::vec4>(arrays.tangents);
  if (arrays.indices) mesh.indices.assign(arrays.indices->data(), arrays.indices->data() + arrays.indices->size());
  return mesh;
}

void add_indices(ModelMesh& mesh) {
  if (!mesh.indices.empty()) return;
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
}

// Returns the asset of a mesh with one material. crease_degrees < 0: flat normals.
std::shared_ptr<ModelAsset> make_model(ModelMesh mesh, const Model& materials, float crease_degrees) {
  if (mesh.topology == MeshTopology::triangles) {
    add_indices(mesh);
    if (mesh.normals.empty() && crease_degrees < 0.0f) add_flat_normals(mesh);
    if (mesh.normals.empty()) add_smooth_normals(mesh, crease_degrees);
  }
  Model model = single_mesh_model("arrays", {}, std::move(mesh));
  model.materials = materials.materials;
  model.images = materials.images;
  model.textures = materials.textures;
  return std::make_shared<ModelAsset>(std::move(model));
}

// Adds an image of shape (H, W, 4) and returns the number of its texture.
int add_texture(Model& model, const py::array& texels, const Sampler& sampler) {
  auto pixels = std::make_shared<const ColorPicture>(pixels_of(texels));
  model.images.push_back({.name = "array", .file = {}, .bytes = nullptr, .pixels = std::move(pixels)});
  model.textures.push_back({static_cast<int>(model.images.size()) - 1, sampler});
  return static_cast<int>(model.textures.size()) - 1;
}

template <class V>
V vector_of(const py::handle& value) {
  const auto list = value.cast<std::vector<float>>();
  V v{};
  for (int i = 0; i < V::length(); ++i) v[i] = list.at(static_cast<std::size_t>(i));
  return v;
}

// Sets the texture of a property. The name of the channel is only used for properties that are single numbers.
void set_texture(ModelMaterial& m, const std::string& property, int texture, Channel channel) {
  const TextureUse use{.texture = texture, .channel = channel};
  if (property == "base_color")
    m.base_color_map = use;
  else if (property == "opacity")
    m.opacity_map = use;
  else if (property == "metallic")
    m.metallic_map = use;
  else if (property == "roughness")
    m.roughness_map = use;
  else if (property == "normal")
    m.normal_map = use;
  else if (property == "occlusion")
    m.occlusion_map = use;
  else if (property == "emissive")
    m.emissive_map = use;
  else
    throw InputError("material: no texture property '" + property + "'");
}

void bind_material(py::module_& m) {
  py::enum_<AlphaMode>(m, "AlphaMode").value("opaque", AlphaMode::opaque).value("mask", AlphaMode::mask).value("blend", AlphaMode::blend);
  py::enum_<Channel>(m, "Channel")
      .value("red", Channel::red)
      .value("green", Channel::green)
      .value("blue", Channel::blue)
      .value("alpha", Channel::alpha);
  py::class_<ModelMaterial>(m, "Material")
      .def(py::init<>())
      .def_readwrite("alpha_mode", &ModelMaterial::alpha_mode)
      .def_readwrite("alpha_cutoff", &ModelMaterial::alpha_cutoff)
      .def_readwrite("metallic", &ModelMaterial::metallic)
      .def_readwrite("roughness", &ModelMaterial::roughness)
      .def_readwrite("specular", &ModelMaterial::specular)
      .def_readwrite("ior", &ModelMaterial::ior)
      .def_readwrite("clearcoat", &ModelMaterial::clearcoat)
      .def_readwrite("clearcoat_roughness", &ModelMaterial::clearcoat_roughness)
      .def_readwrite("sheen", &ModelMaterial::sheen)
      .def_readwrite("sheen_roughness", &ModelMaterial::sheen_roughness)
      .def_readwrite("normal_scale", &ModelMaterial::normal_scale)
      .def_readwrite("occlusion_strength", &ModelMaterial::occlusion_strength)
      .def_readwrite("unlit", &ModelMaterial::unlit)
      .def_readwrite("double_sided", &ModelMaterial::double_sided)
      .def("set_base_color", [](ModelMaterial& self, const py::handle& c) { self.base_color = vector_of<glm::vec4>(c); })
      .def("set_specular_color", [](ModelMaterial& self, const py::handle& c) { self.specular_color = vector_of<glm::vec3>(c); })
      .def("set_emissive", [](ModelMaterial& self, const py::handle& c) { self.emissive = vector_of<glm::vec3>(c); })
      .def("set_texture", &set_texture);
}

void bind_sampler(py::module_& m) {
  py::enum_<Filter>(m, "Filter")
      .value("nearest", Filter::nearest)
      .value("bilinear", Filter::bilinear)
      .value("trilinear", Filter::trilinear)
      .value("nearest_mipmap_nearest", Filter::nearest_mipmap_nearest)
      .value("bilinear_mipmap_nearest", Filter::bilinear_mipmap_nearest)
      .value("nearest_mipmap_linear", Filter::nearest_mipmap_linear);
  py::enum_<Wrap>(m, "Wrap")
      .value("repeat", Wrap::repeat)
      .value("mirrored", Wrap::mirrored)
      .value("clamp", Wrap::clamp)
      .value("mirrored_clamp", Wrap::mirrored_clamp);
  py::class_<Sampler>(m, "Sampler").def(py::init([](Filter min, Filter mag, Wrap wrap_s, Wrap wrap_t, int anisotropy) {
    Sampler s;
    s.mag = mag;
    s.min = min;
    s.wrap_s = wrap_s;
    s.wrap_t = wrap_t;
    s.anisotropy = anisotropy;
    return s;
  }));
}

}  // namespace

void bind_model(py::module_& m) {
  bind_material(m);
  bind_sampler(m);
  py::enum_<MeshTopology>(m, "Topology")
      .value("triangles", MeshTopology::triangles)
      .value("lines", MeshTopology::lines)
      .value("points", MeshTopology::points);
  // The material and the textures of a mesh.
  py::class_<Model>(m, "Materials")
      .def(py::init<>())
      .def("add_texture", &add_texture, py::arg("texels"), py::arg("sampler"))
      .def("set_material", [](Model& self, const ModelMaterial& material) { self.materials = {material}; });
  py::class_<ModelAsset, std::shared_ptr<ModelAsset>>(m, "Model")
      .def(py::init([](const Array<double>& positions, std::optional<Array<float>> normals, std::optional<Array<float>> uvs,
                       std::optional<Array<float>> colors, std::optional<Array<float>> tangents, std::optional<Array<uint32_t>> indices,
                       MeshTopology topology, bool flip_v, const Model& materials, float crease_degrees) {
        ModelMesh mesh = mesh_of({positions, normals, uvs, colors, tangents, indices}, topology, flip_v);
        const py::gil_scoped_release release;
        return make_model(std::move(mesh), materials, crease_degrees);
      }))
      // The number of vertices after splitting at discontinuities of normals and tangents. It can exceed the number of given vertices.
      .def("vertex_count", [](const ModelAsset& self) { return self.model.meshes[0].positions.size(); });
}

}  // namespace halfspace::python
