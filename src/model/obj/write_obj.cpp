// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/write_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

#include "halfspace/core/check.h"
#include "halfspace/model/obj/write_mtl.h"
#include "halfspace/model/pose/world_mesh.h"
#include "halfspace/model/used_images.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the name as a single word that differs from all names in `used`.
std::string obj_name(const std::string& name, const char* fallback, std::set<std::string>& used) {
  std::string word = name.empty() ? fallback : name;
  std::ranges::replace_if(
      word, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\' || c == 127; }, '_');
  std::string unique = word;
  for (int i = 2; !used.insert(unique).second; ++i) unique = fmt::format("{}_{}", word, i);
  return unique;
}

class ObjWriter {
 public:
  /// material_names: the last one is for meshes without a material.
  explicit ObjWriter(const std::vector<std::string>& material_names) : material_names_(material_names) {}

  void add(const WorldMesh& mesh) {
    const ModelMesh& m = mesh.mesh();
    if (m.positions.empty()) return;
    line("o {}\n", obj_name(m.name, "mesh", names_));
    has_default_material_ = has_default_material_ || mesh.material() < 0;
    line("usemtl {}\n", mesh.material() < 0 ? material_names_.back() : material_names_[static_cast<std::size_t>(mesh.material())]);
    for (std::size_t i = 0; i < m.positions.size(); ++i) add_vertex(mesh, i);
    for (const glm::vec2& uv : m.uvs[0]) line("vt {} {}\n", uv.x, 1.0 - static_cast<double>(uv.y));
    for (std::size_t i = 0; i < m.normals.size(); ++i) {
      const glm::vec3 n = mesh.normal(i);
      line("vn {} {} {}\n", n.x, n.y, n.z);
    }
    add_elements(mesh);
    positions_ += m.positions.size();
    uvs_ += m.uvs[0].size();
    normals_ += m.normals.size();
  }

  const std::string& text() const { return text_; }
  bool empty() const { return positions_ == 0; }
  bool has_default_material() const { return has_default_material_; }
  bool has_opacity() const { return has_opacity_; }

  /// Returns the length of the diagonal of the bounds of all positions.
  double diagonal() const { return glm::length(high_ - low_); }

 private:
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
  }

  void add_vertex(const WorldMesh& mesh, std::size_t i) {
    const glm::dvec3 p = mesh.position(i);
    low_ = glm::min(low_, p);
    high_ = glm::max(high_, p);
    line("v {} {} {}", p.x, p.y, p.z);
    if (!mesh.mesh().colors.empty()) {
      const glm::vec4 c = mesh.mesh().colors[i];
      line(" {} {} {}", srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z));
      has_opacity_ = has_opacity_ || c.w != 1.0f;
    }
    text_ += '\n';
  }

  void add_corner(const ModelMesh& m, uint32_t vertex) {
    line(" {}", positions_ + vertex + 1);
    if (m.topology != MeshTopology::triangles || (m.uvs[0].empty() && m.normals.empty())) return;
    text_ += '/';
    if (!m.uvs[0].empty()) line("{}", uvs_ + vertex + 1);
    if (!m.normals.empty()) line("/{}", normals_ + vertex + 1);
  }

  void add_elements(const WorldMesh& mesh) {
    const ModelMesh& m = mesh.mesh();
    if (m.topology == MeshTopology::triangles) {
      for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        text_ += 'f';
        for (std::size_t k = 0; k < 3; ++k) add_corner(m, mesh.corner(t, k));
        text_ += '\n';
      }
      return;
    }
    const bool lines = m.topology == MeshTopology::lines;
    const std::size_t count = m.indices.empty() ? m.positions.size() : m.indices.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (!lines || i % 2 == 0) text_ += lines ? 'l' : 'p';
      add_corner(m, m.indices.empty() ? static_cast<uint32_t>(i) : m.indices[i]);
      if (!lines || i % 2 == 1) text_ += '\n';
    }
  }

  const std::vector<std::string>& material_names_;
  std::string text_;
  std::set<std::string> names_;
  std::size_t positions_ = 0, uvs_ = 0, normals_ = 0;
  glm::dvec3 low_{std::numeric_limits<double>::infinity()}, high_ = -low_;
  bool has_default_material_ = false, has_opacity_ = false;
};

ModelFile text_file(const std::string& name, const std::string& text) {
  ModelFile file{name, {}};
  append_text(file.bytes, text);
  return file;
}

}  // namespace

WrittenModel write_obj(const Model& model, const std::string& stem) {
  WrittenModel written;
  std::vector<std::string> material_names, image_names;
  std::set<std::string> names;
  std::vector<ModelFile> images;
  for (const ModelMaterial& m : model.materials) material_names.push_back(obj_name(m.name, "material", names));
  material_names.push_back(obj_name("default", "", names));
  const std::vector<bool> used = used_images(model);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const ModelImage& image = model.images[i];
    const std::string extension = image.bytes ? image_extension(*image.bytes) : "";
    if (extension.empty() && used[i]) written.warnings.push_back(fmt::format("image '{}' is omitted; expected PNG or JPEG", image.name));
    image_names.push_back(extension.empty() ? "" : fmt::format("{}_image{}{}", stem, i, extension));
    if (!extension.empty()) images.push_back({image_names.back(), *image.bytes});
  }
  const PosedModel posed = pose(model, {});
  ObjWriter writer(material_names);
  for (const PosedMesh& part : posed.meshes) writer.add(WorldMesh(model, part));
  if (writer.empty()) throw InputError(stem + ".obj: the model has no vertices; expected a mesh");
  std::string text;
  const bool has_library = !model.materials.empty() || writer.has_default_material();
  if (has_library) text = "mtllib " + stem + ".mtl\n";
  written.files.push_back(text_file(stem + ".obj", text + writer.text()));
  if (!writer.has_default_material()) material_names.pop_back();
  if (has_library)
    written.files.push_back(text_file(stem + ".mtl", mtl_text(model, material_names, image_names, writer.diagonal(), written.warnings)));
  std::ranges::move(images, std::back_inserter(written.files));
  if (writer.has_opacity()) written.warnings.emplace_back("OBJ cannot store the opacity of vertex colors");
  if (!model.lights.empty() || !model.cameras.empty()) written.warnings.emplace_back("OBJ cannot store lights and cameras");
  if (!model.animations.empty()) written.warnings.emplace_back("OBJ cannot store animations; the model is written at rest");
  return written;
}

}  // namespace halfspace::HS_LANES
