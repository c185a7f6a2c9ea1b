// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/write_ply.h"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/model/pose/world_mesh.h"

namespace halfspace::HS_LANES {

namespace {

class PlyWriter {
 public:
  PlyWriter(const Model& model, const PosedModel& posed) {
    for (const PosedMesh& part : posed.meshes) {
      const WorldMesh mesh(model, part);
      const MeshTopology topology = mesh.mesh().topology;
      (topology == MeshTopology::lines ? has_lines_ : has_points_) |= topology != MeshTopology::triangles;
      if (topology == MeshTopology::lines) continue;
      meshes_.push_back(mesh);
      faces_ += mesh.triangles();
    }
    // In a file with faces, points would be unused vertices.
    if (faces_ > 0) std::erase_if(meshes_, [](const WorldMesh& m) { return m.triangles() == 0; });
    for (const WorldMesh& mesh : meshes_) look_at(mesh);
  }

  std::size_t vertices() const { return vertices_; }
  bool omits_lines() const { return has_lines_; }
  bool omits_points() const { return has_points_ && faces_ > 0; }

  std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    append_text(out, header());
    for (const WorldMesh& mesh : meshes_) {
      for (std::size_t i = 0; i < vertex_count(mesh); ++i) append_vertex(out, mesh, vertex(mesh, i));
    }
    uint32_t first = 0;
    for (const WorldMesh& mesh : meshes_) {
      for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        append_value(out, uint8_t{3});
        for (std::size_t k = 0; k < 3; ++k) append_value(out, first + mesh.corner(t, k));
      }
      first += static_cast<uint32_t>(mesh.mesh().positions.size());
    }
    return out;
  }

 private:
  // Only the points that the indices select are drawn; the others may have invalid positions.
  static bool selects(const ModelMesh& m) { return m.topology == MeshTopology::points && !m.indices.empty(); }

  static std::size_t vertex_count(const WorldMesh& mesh) {
    return selects(mesh.mesh()) ? mesh.mesh().indices.size() : mesh.mesh().positions.size();
  }

  static std::size_t vertex(const WorldMesh& mesh, std::size_t i) { return selects(mesh.mesh()) ? mesh.mesh().indices[i] : i; }

  void look_at(const WorldMesh& mesh) {
    const ModelMesh& m = mesh.mesh();
    vertices_ += vertex_count(mesh);
    normals_ = normals_ && !m.normals.empty();
    colors_ = colors_ || !m.colors.empty();
    opacity_ = opacity_ || std::ranges::any_of(m.colors, [](const glm::vec4& c) { return c.w != 1.0f; });
    uvs_ = uvs_ || !m.uvs[0].empty();
    for (std::size_t i = 0; i < vertex_count(mesh) && !doubles_; ++i) {
      const glm::dvec3 p = mesh.position(vertex(mesh, i));
      doubles_ = glm::dvec3(glm::vec3(p)) != p;
    }
  }

  std::string header() const {
    const char* number = doubles_ ? "double" : "float";
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices_);
    for (const char* name : {"x", "y", "z"}) text += fmt::format("property {} {}\n", number, name);
    if (normals_) text += "property float nx\nproperty float ny\nproperty float nz\n";
    if (uvs_) text += "property double s\nproperty double t\n";
    if (colors_) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (opacity_) text += "property uchar alpha\n";
    if (faces_ > 0) text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n", faces_);
    return text + "end_header\n";
  }

  void append_vertex(std::vector<std::byte>& out, const WorldMesh& mesh, std::size_t i) const {
    const ModelMesh& m = mesh.mesh();
    const glm::dvec3 p = mesh.position(i);
    for (glm::length_t k = 0; k < 3; ++k) doubles_ ? append_value(out, p[k]) : append_value(out, static_cast<float>(p[k]));
    if (normals_) append_value(out, mesh.normal(i));
    if (uvs_) {
      const glm::dvec2 uv(m.uvs[0].empty() ? glm::vec2(0.0f) : m.uvs[0][i]);
      append_value(out, glm::dvec2(uv.x, 1.0 - uv.y));
    }
    if (!colors_) return;
    const glm::vec4 color = m.colors.empty() ? glm::vec4(1.0f) : m.colors[i];
    for (glm::length_t k = 0; k < 3; ++k) append_value(out, static_cast<uint8_t>(linear_to_srgb(color[k])));
    if (opacity_) append_value(out, static_cast<uint8_t>(std::clamp(color.w, 0.0f, 1.0f) * 255.0f + 0.5f));
  }

  std::vector<WorldMesh> meshes_;
  std::size_t vertices_ = 0, faces_ = 0;
  bool normals_ = true, colors_ = false, opacity_ = false, uvs_ = false, doubles_ = false;
  bool has_lines_ = false, has_points_ = false;
};

}  // namespace

WrittenModel write_ply(const Model& model, const std::string& stem) {
  const PosedModel posed = pose(model, {});
  const PlyWriter writer(model, posed);
  if (writer.vertices() == 0) throw InputError(stem + ".ply: the model has neither triangles nor points; expected one of them");
  if (writer.vertices() > 0xffffffffu) throw OutputError(stem + ".ply: more than 2^32 - 1 vertices; expected fewer");
  WrittenModel written;
  written.files.push_back({stem + ".ply", writer.bytes()});
  if (model.materials.size() > 1 || !model.textures.empty())
    written.warnings.emplace_back("PLY stores one mesh with vertex colors: no materials or textures");
  if (writer.omits_lines()) written.warnings.emplace_back("lines are omitted");
  if (writer.omits_points()) written.warnings.emplace_back("points are omitted, because the file has faces");
  return written;
}

}  // namespace halfspace::HS_LANES
