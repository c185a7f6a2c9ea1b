// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/model/geometry/face_triangles.h"
#include "halfspace/model/geometry/mesh_vertices.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/ply/ply_contents.h"
#include "halfspace/model/text/references.h"

namespace halfspace::HS_LANES {

namespace {

// Upper bounds on the memory that is needed while a file is read.
constexpr std::size_t kBytesPerVertex = 160, kBytesPerDataByte = 16;

constexpr std::size_t kMaxCorners = 0xffffffffu;

struct Faces {
  bool are_triangles = false;       ///< all faces are triangles that can be drawn; the list is empty
  std::vector<uint32_t> triangles;  ///< indices of corners
  std::size_t short_faces = 0, infinite_faces = 0;
};

/// Returns whether every face is a triangle of three different finite vertices.
bool are_plain_triangles(const PlyContents& ply) {
  if (ply.lengths.empty() || !std::ranges::all_of(ply.lengths, [](uint32_t length) { return length == 3; })) return false;
  for (std::size_t i = 0; i < ply.corners.size(); i += 3) {
    const uint32_t a = ply.corners[i], b = ply.corners[i + 1], c = ply.corners[i + 2];
    if (a == b || b == c || c == a) return false;
  }
  return std::ranges::all_of(ply.positions, [](const glm::dvec3& p) { return is_finite(p); });
}

/// Converts faces to triangles.
class FaceConverter {
 public:
  explicit FaceConverter(const PlyContents& ply) : ply_(ply) {}

  Faces convert() {
    faces_.are_triangles = are_plain_triangles(ply_);
    if (faces_.are_triangles) return std::move(faces_);
    faces_.triangles.reserve(ply_.corners.size());
    uint32_t first = 0;
    for (const uint32_t length : ply_.lengths) add(std::exchange(first, first + length), length);
    return std::move(faces_);
  }

 private:
  // Neighboring corners at the same vertex count as one.
  void add(uint32_t first, uint32_t length) {
    corners_.clear();
    for (uint32_t i = first; i < first + length; ++i) {
      if (corners_.empty() || ply_.corners[i] != ply_.corners[corners_.back()]) corners_.push_back(i);
    }
    while (corners_.size() > 1 && ply_.corners[corners_.back()] == ply_.corners[corners_.front()]) corners_.pop_back();
    const auto position = [&](uint32_t corner) { return ply_.positions[ply_.corners[corner]]; };
    if (corners_.size() < 3) {
      ++faces_.short_faces;
    } else if (!std::ranges::all_of(corners_, [&](uint32_t corner) { return is_finite(position(corner)); })) {
      ++faces_.infinite_faces;
    } else if (corners_.size() == 3) {
      faces_.triangles.insert(faces_.triangles.end(), corners_.begin(), corners_.end());
    } else {
      polygon_.clear();
      for (const uint32_t corner : corners_) polygon_.push_back(position(corner));
      for (const uint32_t i : triangles_.of(polygon_)) faces_.triangles.push_back(corners_[i]);
    }
  }

  const PlyContents& ply_;
  Faces faces_;
  std::vector<uint32_t> corners_;
  std::vector<glm::dvec3> polygon_;
  FaceTriangles triangles_;
};

/// Selects vertices and all their data.
void select_vertices(PlyContents& ply, std::span<const uint32_t> sources) {
  select_items(ply.positions, sources);
  select_items(ply.normals, sources);
  select_items(ply.uvs, sources);
  select_items(ply.colors.values, sources);
}

/// Gives every corner of a face its own vertex, because texture coordinates or colors differ between the faces around a vertex.
void separate_corners(PlyContents& ply) {
  select_vertices(ply, ply.corners);
  if (!ply.corner_uvs.empty()) ply.uvs = std::move(ply.corner_uvs);
  if (ply.face_colors.values.empty() || !ply.colors.values.empty()) return;
  ply.colors.types = ply.face_colors.types;
  ply.colors.values.reserve(ply.corners.size());
  for (std::size_t face = 0; face < ply.lengths.size(); ++face) {
    ply.colors.values.insert(ply.colors.values.end(), ply.lengths[face], ply.face_colors.values[face]);
  }
}

/// Returns the triangles as indices of vertices.
std::vector<uint32_t> triangle_indices(PlyContents& ply, Faces faces) {
  if (!ply.corner_uvs.empty() || (!ply.face_colors.values.empty() && ply.colors.values.empty())) {
    if (faces.are_triangles) {
      faces.triangles.resize(ply.corners.size());
      std::iota(faces.triangles.begin(), faces.triangles.end(), 0u);
    }
    separate_corners(ply);
    return std::move(faces.triangles);
  }
  if (faces.are_triangles) return std::move(ply.corners);
  for (uint32_t& corner : faces.triangles) corner = ply.corners[corner];
  return std::move(faces.triangles);
}

using Warn = std::function<void(std::size_t count, std::string_view what)>;

/// Sets the topology and the indices of a mesh without faces.
void set_lines_or_points(ModelMesh& mesh, const PlyContents& ply, const Warn& warn) {
  const auto finite = [&](uint32_t v) { return is_finite(ply.positions[v]); };
  mesh.topology = MeshTopology::lines;
  for (std::size_t i = 0; i + 1 < ply.edges.size(); i += 2) {
    if (ply.edges[i] != ply.edges[i + 1]) mesh.indices.insert(mesh.indices.end(), {ply.edges[i], ply.edges[i + 1]});
  }
  warn(remove_primitives(mesh.topology, mesh.indices, finite), "edges with coordinates that are not finite; skipped");
  if (!mesh.indices.empty()) return;
  mesh.topology = MeshTopology::points;
  mesh.indices.resize(ply.positions.size());
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
  warn(remove_primitives(mesh.topology, mesh.indices, finite), "points with coordinates that are not finite; skipped");
  if (mesh.indices.empty()) throw InputError("no vertex has finite coordinates; expected at least one");
}

/// Sets the topology and the indices of a mesh, and removes the vertices that it does not use.
void set_primitives(ModelMesh& mesh, PlyContents& ply, const Warn& warn) {
  Faces faces = FaceConverter(ply).convert();
  warn(faces.short_faces, "faces with fewer than 3 different vertices; skipped");
  warn(faces.infinite_faces, "faces with coordinates that are not finite; skipped");
  if (faces.are_triangles || !faces.triangles.empty()) {
    mesh.indices = triangle_indices(ply, std::move(faces));
  } else {
    set_lines_or_points(mesh, ply, warn);
  }
  const std::vector<uint32_t> used = compact_indices(mesh.indices, ply.positions.size());
  if (!used.empty()) select_vertices(ply, used);
  if (mesh.topology == MeshTopology::points) mesh.indices.clear();  // all that are left
}

/// Sets the normals, texture coordinates and colors of a mesh with positions. Replaces those that cannot be used.
void set_attributes(ModelMesh& mesh, PlyContents& ply, const Warn& warn) {
  std::size_t bad_uvs = 0, bad_colors = 0;
  for (glm::vec2& uv : ply.uvs) {
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
    uv = glm::vec2(0.0f);
    ++bad_uvs;
  }
  mesh.uvs[0] = std::move(ply.uvs);
  warn(bad_uvs, "texture coordinates that are not finite; replaced by 0");
  mesh.colors = linear_ply_colors(ply.colors, bad_colors);
  warn(bad_colors, "colors that are not finite; replaced by white");
  if (ply.normals.empty()) return;
  mesh.normals.resize(ply.normals.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < ply.normals.size(); ++i) {
    const double length = std::sqrt(glm::dot(ply.normals[i], ply.normals[i]));
    if (length > 0.0 && std::isfinite(length)) mesh.normals[i] = unit_vector(ply.normals[i]);
  }
  if (mesh.topology != MeshTopology::triangles) {  // without faces to compute a normal from
    if (std::ranges::find(mesh.normals, glm::vec3(0.0f)) != mesh.normals.end()) mesh.normals.clear();
    return;
  }
  const std::size_t replaced = replace_missing_normals(mesh);
  warn(replaced, "normals that are zero or not finite; computed from the faces");
  if (replaced == mesh.normals.size()) mesh.normals.clear();
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
  check_memory(ply.positions.size() * kBytesPerVertex + ply.corners.size() * kBytesPerTriangle, options);
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  ModelMesh mesh;
  set_primitives(mesh, ply, warn);
  set_positions(mesh, ply.positions);
  set_attributes(mesh, ply, warn);
  ignore_zero_opacity(mesh.colors, warnings);
  if (mesh.topology == MeshTopology::triangles && mesh.normals.empty()) {
    add_smooth_normals(mesh, options.crease_degrees);
    mesh.computed_normals = true;
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

}  // namespace halfspace::HS_LANES
