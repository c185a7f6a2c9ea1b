// SPDX-License-Identifier: Apache-2.0
//
// Tangents are computed in double and rounded once. Only the angles are floats (atan2 in lane_math.h), so that the result is bit-identical
// on every machine. Differences from MikkTSpace: all triangles around a vertex are averaged, even if they are not connected by edges.
// Triangles with zero area are ignored, whereas MikkTSpace copies tangents to them from other triangles. Compared with the npm package
// mikktspace 1.1.1, all 23,322 corners of Khronos's NormalTangentTest agree within 0.0001°, and 99.4% of the 46,356 corners of
// DamagedHelmet agree within 0.1°; 9 corners differ by more than 10°.
#include "halfspace/model/geometry/tangents.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "halfspace/core/check.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/model/geometry/mesh_vertices.h"

namespace halfspace::HS_LANES {

namespace {

constexpr uint32_t kNoVertex = std::numeric_limits<uint32_t>::max();

/// Vertex data that must be equal for tangents to be averaged.
using VertexKey = std::array<uint32_t, 8>;

VertexKey key_of(const glm::vec3& p, const glm::vec3& n, const glm::vec2& uv) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // −0 becomes 0
  return {bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z), bits(uv.x), bits(uv.y)};
}

uint64_t hash_of(const VertexKey& key) {
  uint64_t h = 0;
  for (const uint32_t word : key) {
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
  }
  return h;
}

/// Returns for every vertex the index of the first vertex with the same key.
std::vector<uint32_t> first_equal_vertices(const ModelMesh& mesh, const std::vector<glm::vec2>& uvs) {
  const std::size_t n = mesh.positions.size();
  const auto key = [&](std::size_t i) { return key_of(mesh.positions[i], mesh.normals[i], uvs[i]); };
  std::vector<uint32_t> table(std::bit_ceil(2 * n + 1), kNoVertex), first(n);
  for (std::size_t i = 0; i < n; ++i) {
    const VertexKey k = key(i);
    std::size_t slot = hash_of(k) & (table.size() - 1);
    while (table[slot] != kNoVertex && key(table[slot]) != k) slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == kNoVertex) table[slot] = static_cast<uint32_t>(i);
    first[i] = table[slot];
  }
  return first;
}

/// Returns the projection of v onto the plane with normal n, normalized; 0 if it has no direction.
glm::dvec3 unit_in_plane(const glm::dvec3& v, const glm::dvec3& n) {
  const glm::dvec3 p = v - n * glm::dot(n, v);
  const double length = std::sqrt(glm::dot(p, p));
  return length > 0.0 ? p / length : glm::dvec3(0.0);
}

glm::dvec3 any_perpendicular(const glm::dvec3& n) {
  const glm::dvec3 a = glm::abs(n);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0) : a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  return unit_in_plane(axis, n);
}

/// The orientation of the texture coordinates of a triangle: the sign of the bitangent, or none if they have no area.
enum class Orientation : uint8_t { positive, negative, none };

class TangentBuilder {
 public:
  TangentBuilder(ModelMesh& mesh, int uv_set)
      : mesh_(mesh),
        uvs_(mesh.uvs[static_cast<std::size_t>(uv_set)]),
        first_(first_equal_vertices(mesh, uvs_)),
        orientations_(mesh.indices.size() / 3) {
    for (auto& sums : sums_) sums.assign(mesh.positions.size(), glm::dvec3(0.0));
  }

  void build() {
    for (std::size_t t = 0; t < orientations_.size(); ++t) add_triangle(t);
    split_vertices();
    mesh_.tangents.resize(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh_.tangents.size(); ++i) mesh_.tangents[i] = tangent(i);
  }

 private:
  void add_triangle(std::size_t t) {
    const uint32_t* const corners = &mesh_.indices[3 * t];
    const auto position = [&](std::size_t k) { return glm::dvec3(mesh_.positions[corners[k % 3]]); };
    const auto uv = [&](std::size_t k) { return glm::dvec2(uvs_[corners[k]]); };
    const glm::dvec3 edge1 = position(1) - position(0), edge2 = position(2) - position(0);
    const glm::dvec2 uv1 = uv(1) - uv(0), uv2 = uv(2) - uv(0);
    const double area = uv1.x * uv2.y - uv1.y * uv2.x;
    const glm::dvec3 increasing_u = (uv2.y * edge1 - uv1.y * edge2) * (area < 0.0 ? -1.0 : 1.0);
    orientations_[t] = area == 0.0 || increasing_u == glm::dvec3(0.0) ? Orientation::none
                       : area < 0.0                                   ? Orientation::positive  // v points down
                                                                      : Orientation::negative;
    if (orientations_[t] == Orientation::none) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 n(mesh_.normals[corners[k]]);
      const glm::dvec3 a = unit_in_plane(position(k + 1) - position(k), n), b = unit_in_plane(position(k + 2) - position(k), n);
      const glm::dvec3 normal = glm::cross(a, b);
      const float angle = atan2(static_cast<float>(std::sqrt(glm::dot(normal, normal))), static_cast<float>(glm::dot(a, b)));
      sum(corners[k], orientations_[t]) += unit_in_plane(increasing_u, n) * static_cast<double>(angle);
    }
  }

  glm::dvec3& sum(uint32_t vertex, Orientation orientation) { return sums_[static_cast<std::size_t>(orientation)][first_[vertex]]; }

  // Separates the vertices of triangles with different orientations. Triangles without an orientation share the vertices of the others.
  void split_vertices() {
    std::vector<uint32_t> sources(mesh_.positions.size()), copies(mesh_.positions.size(), kNoVertex);
    for (std::size_t i = 0; i < sources.size(); ++i) sources[i] = static_cast<uint32_t>(i);
    vertex_orientations_.assign(sources.size(), Orientation::none);
    for (std::size_t i = 0; i < mesh_.indices.size(); ++i) {
      uint32_t& vertex = mesh_.indices[i];
      const Orientation wanted = orientations_[i / 3];
      if (wanted == Orientation::none) continue;
      Orientation& present = vertex_orientations_[vertex];
      if (present == Orientation::none) present = wanted;
      if (present == wanted) continue;
      if (copies[vertex] == kNoVertex) {
        copies[vertex] = static_cast<uint32_t>(sources.size());
        sources.push_back(vertex);
        vertex_orientations_.push_back(wanted);
      }
      vertex = copies[vertex];
    }
    const std::size_t before = mesh_.positions.size();
    if (sources.size() == before) return;
    mesh_.tangents.clear();
    copy_vertices(mesh_, sources);
    first_.resize(sources.size());
    for (std::size_t i = before; i < sources.size(); ++i) first_[i] = first_[sources[i]];
  }

  glm::vec4 tangent(std::size_t vertex) {
    const glm::dvec3 n(mesh_.normals[vertex]);
    Orientation orientation = vertex_orientations_[vertex];
    if (orientation == Orientation::none) {
      const bool has_positive = sum(static_cast<uint32_t>(vertex), Orientation::positive) != glm::dvec3(0.0);
      const bool has_negative = sum(static_cast<uint32_t>(vertex), Orientation::negative) != glm::dvec3(0.0);
      orientation = has_negative && !has_positive ? Orientation::negative : Orientation::positive;
    }
    const glm::dvec3 mean = unit_in_plane(sum(static_cast<uint32_t>(vertex), orientation), n);
    const glm::dvec3 t = mean == glm::dvec3(0.0) ? any_perpendicular(n) : mean;
    return {glm::vec3(t + 0.0), orientation == Orientation::negative ? -1.0f : 1.0f};
  }

  ModelMesh& mesh_;
  const std::vector<glm::vec2>& uvs_;
  std::vector<uint32_t> first_;
  std::vector<Orientation> orientations_;         // of triangles
  std::vector<Orientation> vertex_orientations_;  // of their vertices
  std::array<std::vector<glm::dvec3>, 2> sums_;   // weighted tangents for each orientation; the vertices are those of first_
};

}  // namespace

void add_tangents(ModelMesh& mesh, int uv_set) {
  HS_CHECK(mesh.topology == MeshTopology::triangles, "add_tangents: the mesh has lines or points; expected triangles");
  HS_CHECK(uv_set == 0 || uv_set == 1, "add_tangents: there is no such set of texture coordinates; expected 0 or 1");
  HS_CHECK(mesh.normals.size() == mesh.positions.size(),
           "add_tangents: the number of normals differs from that of positions; expected one normal per vertex");
  HS_CHECK(mesh.uvs[static_cast<std::size_t>(uv_set)].size() == mesh.positions.size(),
           "add_tangents: the number of texture coordinates differs from that of positions; expected one pair per vertex");
  TangentBuilder(mesh, uv_set).build();
}

}  // namespace halfspace::HS_LANES
