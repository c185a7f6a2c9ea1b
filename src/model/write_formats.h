// SPDX-License-Identifier: Apache-2.0
//
// The writers of written_model(). Private to the files that implement it.
#pragma once

#include <string>
#include <string_view>

#include "halfspace/model/pose.h"
#include "halfspace/model/write_model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// stem: the name of the main file without its extension.
WrittenModel write_gltf(const Model& model, const std::string& stem, bool binary);
WrittenModel write_obj(const Model& model, const std::string& stem);
WrittenModel write_ply(const Model& model, const std::string& stem);
WrittenModel write_stl(const Model& model, const std::string& stem);

/// Appends the bytes of a value, which are little-endian on all supported machines.
template <class T>
void append_value(std::vector<std::byte>& bytes, const T& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

void append_text(std::vector<std::byte>& bytes, std::string_view text);

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

}  // namespace halfspace::inline HS_LANES_NAMESPACE
