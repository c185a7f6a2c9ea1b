// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/mesh_vertices.h"

#include <utility>

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

template <class T>
void copy_list(std::vector<T>& list, std::span<const uint32_t> sources) {
  if (list.empty()) return;
  std::vector<T> copies(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) copies[i] = list[sources[i]];
  list = std::move(copies);
}

}  // namespace

void copy_vertices(ModelMesh& mesh, std::span<const uint32_t> sources) {
  copy_list(mesh.positions, sources);
  copy_list(mesh.normals, sources);
  copy_list(mesh.tangents, sources);
  for (auto& uvs : mesh.uvs) copy_list(uvs, sources);
  copy_list(mesh.colors, sources);
  for (MorphTarget& target : mesh.targets) {
    copy_list(target.positions, sources);
    copy_list(target.normals, sources);
    copy_list(target.tangents, sources);
  }
  copy_list(mesh.joints, sources);
  copy_list(mesh.weights, sources);
  copy_list(mesh.more_joints, sources);
  copy_list(mesh.more_weights, sources);
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
