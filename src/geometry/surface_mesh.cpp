// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/surface_mesh.h"

#include <cmath>

#include "halfspace/geometry/double_vectors.h"

namespace halfspace::HS_LANES {

namespace {

double length_of(const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

SurfaceVertex rounded_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent) {
  return {rounded(position), rounded(normal), glm::vec4(rounded(tangent), 1.0f)};
}

}  // namespace

SurfaceVertex vertex_of(const MeshPoint& p, const Displacement* displacement) {
  if (displacement == nullptr) return rounded_vertex(p.position, p.normal, p.du / length_of(p.du));
  const HeightSample h = displacement->field->at(p.uv.x, p.uv.y);
  const double whole = displacement->scale * (h.value - displacement->zero);
  const double g = p.fade.value * whole;
  const double gu = p.fade.value * displacement->scale * h.du + p.fade.du * whole;
  const double gv = p.fade.value * displacement->scale * h.dv + p.fade.dv * whole;
  const glm::dvec3 du = p.du + g * p.normal_du + gu * p.normal;
  const glm::dvec3 dv = p.dv + g * p.normal_dv + gv * p.normal;
  const glm::dvec3 normal = glm::cross(dv, du);
  return rounded_vertex(p.position + g * p.normal, normal / length_of(normal), du / length_of(du));
}

FadeStep fade_in(double x) {
  const double s = x / kFadeWidth;
  if (s >= 1.0) return {1.0, 0.0};
  return {s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / kFadeWidth};
}

double SurfaceMesh::height_at(const MeshPoint& p) const {
  if (displacement_ == nullptr) return 0.0;
  return p.fade.value * displacement_->scale * (displacement_->field->at(p.uv.x, p.uv.y).value - displacement_->zero);
}

int SurfaceMesh::add(const MeshPoint& p) { return add_vertex(vertex_of(p, displacement_), p.uv); }

int SurfaceMesh::add_pole(const MeshPoint& p, double g) {
  return add_vertex(rounded_vertex(p.position + g * p.normal, p.normal, p.tangent), p.uv);
}

int SurfaceMesh::add_vertex(const SurfaceVertex& vertex, const glm::dvec2& uv) {
  mesh_.positions.push_back(vertex.position);
  mesh_.normals.push_back(vertex.normal);
  mesh_.tangents.push_back(vertex.tangent);
  mesh_.uvs.emplace_back(uv);
  return static_cast<int>(mesh_.positions.size()) - 1;
}

void SurfaceMesh::add_triangle(int a, int b, int c) {
  for (const int i : {a, b, c}) mesh_.indices.push_back(static_cast<uint32_t>(i));
}

void SurfaceMesh::add_grid(int first, int columns, int rows) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int north_west = first + i * (columns + 1) + j, south_west = north_west + columns + 1;
      add_triangle(north_west, south_west, south_west + 1);
      add_triangle(north_west, south_west + 1, north_west + 1);
    }
  }
}

}  // namespace halfspace::HS_LANES
