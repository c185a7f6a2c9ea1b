// SPDX-License-Identifier: Apache-2.0
//
// Selects vertices of meshes.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Replaces a list by copies of its items: the new item i is list[sources[i]]. An empty list stays empty.
template <class T>
void select_items(std::vector<T>& list, std::span<const uint32_t> sources) {
  if (list.empty()) return;
  std::vector<T> copies(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) copies[i] = list[sources[i]];
  list = std::move(copies);
}

/// Replaces the vertices of a mesh: the new vertex i is a copy of the old vertex sources[i], with all its data. Indices are not changed.
void copy_vertices(ModelMesh& mesh, std::span<const uint32_t> sources);

/// Renumbers the vertices that `indices` refers to from 0, keeping their order, and returns their former indices. Returns an empty list and
/// changes nothing if all `count` vertices are used.
std::vector<uint32_t> compact_indices(std::vector<uint32_t>& indices, std::size_t count);

/// Removes the vertices that no index refers to. A mesh without indices uses all its vertices.
void remove_unused_vertices(ModelMesh& mesh);

/// Removes the points, lines or triangles for which is_usable(vertex) is false at one of their vertices. Returns their number. `indices` is
/// a list of primitives of this topology.
template <class F>
std::size_t remove_primitives(MeshTopology topology, std::vector<uint32_t>& indices, const F& is_usable) {
  const std::size_t corners = topology == MeshTopology::triangles ? 3 : topology == MeshTopology::lines ? 2 : 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i + corners <= indices.size(); i += corners) {
    bool usable = true;
    for (std::size_t k = 0; k < corners; ++k) usable = usable && is_usable(indices[i + k]);
    for (std::size_t k = 0; usable && k < corners; ++k) indices[kept++] = indices[i + k];
  }
  const std::size_t removed = (indices.size() - kept) / corners;
  indices.resize(kept);
  return removed;
}

}  // namespace halfspace::HS_LANES
