// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/stl/write_stl.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/model/pose/world_mesh.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kStlHeader = 80;

// Converts y-up to z-up.
glm::dvec3 z_up(const glm::dvec3& p) { return {p.x, -p.z, p.y}; }

void append_vector(std::vector<std::byte>& bytes, const glm::dvec3& v) {
  for (glm::length_t k = 0; k < 3; ++k) append_value(bytes, static_cast<float>(v[k]));
}

void append_stl_triangle(std::vector<std::byte>& bytes, const WorldMesh& mesh, std::size_t triangle) {
  std::array<glm::dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = z_up(mesh.position(mesh.corner(triangle, k)));
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = std::sqrt(glm::dot(normal, normal));
  append_vector(bytes, length > 0.0 ? normal / length : glm::dvec3(0.0));
  for (const glm::dvec3& corner : corners) append_vector(bytes, corner);
  append_value(bytes, uint16_t{0});
}

}  // namespace

WrittenModel write_stl(const Model& model, const std::string& stem) {
  const PosedModel posed = pose(model, {});
  std::vector<std::byte> bytes(kStlHeader);
  std::size_t triangles = 0;
  bool has_lines_or_points = false;
  append_value(bytes, uint32_t{0});
  for (const PosedMesh& part : posed.meshes) {
    const WorldMesh mesh(model, part);
    for (std::size_t t = 0; t < mesh.triangles(); ++t) append_stl_triangle(bytes, mesh, t);
    triangles += mesh.triangles();
    has_lines_or_points = has_lines_or_points || mesh.mesh().topology != MeshTopology::triangles;
  }
  if (triangles == 0) throw InputError(stem + ".stl: the model has no triangles; expected triangles");
  if (triangles > 0xffffffffu) throw OutputError(stem + ".stl: more than 2^32 - 1 triangles; expected fewer");
  const auto count = static_cast<uint32_t>(triangles);
  std::copy_n(reinterpret_cast<const std::byte*>(&count), sizeof count, bytes.begin() + kStlHeader);
  WrittenModel written;
  written.files.push_back({stem + ".stl", std::move(bytes)});
  if (!model.materials.empty()) written.warnings.emplace_back("STL stores only triangles, without materials, textures, normals or colors");
  if (has_lines_or_points) written.warnings.emplace_back("lines and points are omitted");
  return written;
}

}  // namespace halfspace::HS_LANES
