// SPDX-License-Identifier: Apache-2.0
//
// A posed mesh in world space, for formats without nodes.
#pragma once

#include "halfspace/model/pose/pose.h"

namespace halfspace::HS_LANES {

/// A mesh in world space.
class WorldMesh {
 public:
  /// The arguments must outlive this object.
  WorldMesh(const Model& model, const PosedMesh& posed);

  const ModelMesh& mesh() const { return *mesh_; }
  int material() const { return material_; }
  glm::dvec3 position(std::size_t vertex) const;
  /// Unit length. The mesh must have normals.
  glm::vec3 normal(std::size_t vertex) const;
  /// Returns corner 0, 1 or 2 of a triangle. The winding of mirrored meshes is reversed.
  uint32_t corner(std::size_t triangle, std::size_t corner) const;
  std::size_t triangles() const { return mesh_->topology == MeshTopology::triangles ? mesh_->indices.size() / 3 : 0; }

 private:
  const ModelMesh* mesh_;
  int material_;
  glm::dmat4 world_from_mesh_;
  glm::dmat3 normal_from_mesh_;
  bool turned_, mirrored_;
};

}  // namespace halfspace::HS_LANES
