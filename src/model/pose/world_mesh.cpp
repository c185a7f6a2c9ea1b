// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/world_mesh.h"

#include <cmath>

namespace halfspace::HS_LANES {

WorldMesh::WorldMesh(const Model& model, const PosedMesh& posed)
    : mesh_(posed.deformed ? posed.deformed.get() : &model.meshes[static_cast<std::size_t>(posed.mesh)]),
      material_(posed.material),
      world_from_mesh_(posed.world_from_mesh),
      normal_from_mesh_(1.0) {
  const glm::dmat3 linear(posed.world_from_mesh);
  turned_ = linear != glm::dmat3(1.0);
  const double determinant = glm::determinant(linear);
  mirrored_ = determinant < 0.0;
  if (turned_ && determinant != 0.0) normal_from_mesh_ = glm::transpose(glm::inverse(linear));
}

glm::dvec3 WorldMesh::position(std::size_t vertex) const {
  const glm::dvec3 p(mesh_->positions[vertex]);
  return turned_ ? glm::dvec3(world_from_mesh_ * glm::dvec4(p, 1.0)) : p + glm::dvec3(world_from_mesh_[3]);
}

glm::vec3 WorldMesh::normal(std::size_t vertex) const {
  const glm::vec3 n = mesh_->normals[vertex];
  if (!turned_) return n;
  const glm::dvec3 world = normal_from_mesh_ * glm::dvec3(n);
  const double length = std::sqrt(glm::dot(world, world));
  return length > 0.0 ? glm::vec3(world / length) : n;
}

uint32_t WorldMesh::corner(std::size_t triangle, std::size_t corner) const {
  return mesh_->indices[3 * triangle + (mirrored_ && corner > 0 ? 3 - corner : corner)];
}

}  // namespace halfspace::HS_LANES
