// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/model/mesh_vertices.h"
#include "halfspace/model/normals.h"
#include "halfspace/model/ply_contents.h"
#include "halfspace/model/references.h"
#include "halfspace/model/single_mesh.h"
#include "halfspace/model/triangulate.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// Upper bounds on the memory that is needed while a file is read.
constexpr std::size_t kBytesPerVertex = 160, kBytesPerDataByte = 16;

constexpr std::size_t kMaxCorners = 0xffffffffu;

struct Faces {
  bool are_triangles = false;       ///< all faces are triangles that can be drawn; the list is empty
  std::vector<uint32_t> triangles;  ///< indices of corners
  std::size_t short_faces = 0, infinite_faces = 0;
};

Faces triangles_of(const PlyContents& ply) {
  Faces faces;
  faces.are_triangles = !ply.lengths.empty() && std::ranges::all_of(ply.lengths, [](uint32_t length) { return length == 3; }) &&
                        std::ranges::all_of(ply.positions, [](const glm::dvec3& p) { return is_finite(p); });
  if (faces.are_triangles) return faces;
  faces.triangles.reserve(ply.corners.size());
  std::vector<glm::dvec3> polygon;
  std::vector<uint32_t> pieces;
  uint32_t first = 0;
  for (const uint32_t length : ply.lengths) {
    const auto corners = std::span(ply.corners).subspan(first, length);
    const uint32_t begin = std::exchange(first, first + length);
    if (length < 3) {
      ++faces.short_faces;
    } else if (!std::ranges::all_of(corners, [&](uint32_t v) { return is_finite(ply.positions[v]); })) {
      ++faces.infinite_faces;
    } else if (length == 3) {
      faces.triangles.insert(faces.triangles.end(), {begin, begin + 1, begin + 2});
    } else {
      polygon.clear();
      pieces.clear();
      for (const uint32_t v : corners) polygon.push_back(ply.positions[v]);
      triangulate(polygon, pieces);
      for (const uint32_t corner : pieces) faces.triangles.push_back(begin + corner);
    }
  }
  return faces;
}

/// Returns the normals normalized, or an empty list if one of them has no direction.
std::vector<glm::vec3> unit_normals(const std::vector<glm::dvec3>& normals) {
  std::vector<glm::vec3> units(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double length = std::sqrt(glm::dot(normals[i], normals[i]));
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    units[i] = unit_vector(normals[i]);
  }
  return units;
}

/// Gives every corner of a face its own vertex, because texture coordinates or colors differ between the faces around a vertex.
void separate_corners(ModelMesh& mesh, const PlyContents& ply) {
  copy_vertices(mesh, ply.corners);
  if (!ply.corner_uvs.empty()) mesh.uvs[0] = ply.corner_uvs;
  if (ply.face_colors.empty() || !mesh.colors.empty()) return;
  mesh.colors.reserve(ply.corners.size());
  for (std::size_t face = 0; face < ply.lengths.size(); ++face) {
    mesh.colors.insert(mesh.colors.end(), ply.lengths[face], ply.face_colors[face]);
  }
}

void add_triangles(ModelMesh& mesh, PlyContents& ply, Faces faces, float crease_degrees) {
  mesh.indices = std::move(faces.triangles);
  if (!ply.corner_uvs.empty() || (!ply.face_colors.empty() && mesh.colors.empty())) {
    if (faces.are_triangles) {
      mesh.indices.resize(ply.corners.size());
      std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    }
    separate_corners(mesh, ply);
  } else if (faces.are_triangles) {
    mesh.indices = std::move(ply.corners);
  } else {
    for (uint32_t& corner : mesh.indices) corner = ply.corners[corner];
  }
  if (!mesh.normals.empty()) return;
  add_smooth_normals(mesh, crease_degrees);
  mesh.computed_normals = true;
}

void add_lines_or_points(ModelMesh& mesh, const PlyContents& ply) {
  const auto finite = [&](uint32_t v) { return is_finite(ply.positions[v]); };
  mesh.topology = MeshTopology::lines;
  for (std::size_t i = 0; i + 1 < ply.edges.size(); i += 2) {
    if (finite(ply.edges[i]) && finite(ply.edges[i + 1])) mesh.indices.insert(mesh.indices.end(), {ply.edges[i], ply.edges[i + 1]});
  }
  if (!mesh.indices.empty()) return;
  mesh.topology = MeshTopology::points;
  for (uint32_t v = 0; v < ply.positions.size(); ++v) {
    if (finite(v)) mesh.indices.push_back(v);
  }
  if (mesh.indices.size() == ply.positions.size()) mesh.indices.clear();
}

/// Some programs write 0 as the opacity of all vertices.
void ignore_zero_opacity(std::vector<glm::vec4>& colors, std::vector<std::string>& warnings) {
  if (colors.empty() || !std::ranges::all_of(colors, [](const glm::vec4& c) { return c.w == 0.0f; })) return;
  for (glm::vec4& color : colors) color.w = 1.0f;
  warnings.emplace_back("all colors are fully transparent; their opacity is ignored");
}

void add_texture(Model& model, const PlyHeader& header, const std::filesystem::path& file, const ReadModelOptions& options) {
  if (header.texture_files.empty() || model.meshes[0].uvs[0].empty()) return;
  if (header.texture_files.size() > 1) model.warnings.emplace_back("several textures; all faces use the first");
  const std::optional<std::filesystem::path> image =
      References(file, options.allow_outside, model.warnings).find(header.texture_files[0], "the texture");
  if (!image) return;
  model.images.push_back({header.texture_files[0], *image, nullptr});
  model.textures.push_back({0, {}});
  model.materials[0].base_color_map.texture = 0;
  model.materials[0].base_color = glm::vec4(1.0f);
}

Model model_of(PlyContents ply, const std::filesystem::path& file, const ReadModelOptions& options) {
  if (ply.positions.empty()) throw InputError("no vertices; expected an element 'vertex' with at least one row");
  if (ply.corners.size() >= kMaxCorners)
    throw InputError(fmt::format("the faces have {} vertex indices; expected fewer than 2^32 - 1", ply.corners.size()));
  std::vector<std::string> warnings;
  const auto warn = [&](std::ptrdiff_t count, std::string_view what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}; skipped", count, what));
  };
  warn(std::ranges::count_if(ply.positions, [](const glm::dvec3& p) { return !is_finite(p); }),
       "vertices whose coordinates are not finite");
  ModelMesh mesh;
  set_positions(mesh, ply.positions);
  ignore_zero_opacity(ply.colors, warnings);
  ignore_zero_opacity(ply.face_colors, warnings);
  mesh.uvs[0] = std::move(ply.uvs);
  mesh.colors = std::move(ply.colors);
  mesh.normals = unit_normals(ply.normals);
  if (mesh.normals.empty() && !ply.normals.empty()) warnings.emplace_back("a normal has no direction; the normals of the file are ignored");
  check_memory(ply.positions.size() * kBytesPerVertex + ply.corners.size() * kBytesPerTriangle, options);
  Faces faces = triangles_of(ply);
  warn(static_cast<std::ptrdiff_t>(faces.short_faces), "faces with fewer than 3 vertices");
  warn(static_cast<std::ptrdiff_t>(faces.infinite_faces), "faces that use skipped vertices");
  if (faces.are_triangles || !faces.triangles.empty()) {
    add_triangles(mesh, ply, std::move(faces), options.crease_degrees);
  } else {
    add_lines_or_points(mesh, ply);
  }
  Model model = single_mesh_model("PLY", file, std::move(mesh));
  model.warnings = std::move(warnings);
  return model;
}

}  // namespace

Model read_ply(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options) {
  const std::string name = file.string();
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const PlyHeader header = parse_ply_header(text, name);
  const std::string_view data = text.substr(header.size);
  try {
    std::size_t vertices = 0;
    for (const PlyElement& element : header.elements) vertices += element.name == "vertex" ? element.count : 0;
    check_memory(vertices * kBytesPerVertex + data.size() * kBytesPerDataByte, options);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));
  }
  PlyContents contents = read_ply_contents(header, data, name);
  Model model;
  try {
    model = model_of(std::move(contents), file, options);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));
  }
  add_texture(model, header, file, options);
  return model;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
