// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/mesh_vertices.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// For a few vertices of a long list, whose length would decide the memory of a table.
std::vector<uint32_t> compact_by_sorting(std::vector<uint32_t>& indices) {
  std::vector<uint32_t> used = indices;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (uint32_t& index : indices) index = static_cast<uint32_t>(std::ranges::lower_bound(used, index) - used.begin());
  return used;
}

}  // namespace

void copy_vertices(ModelMesh& mesh, std::span<const uint32_t> sources) {
  select_items(mesh.positions, sources);
  select_items(mesh.normals, sources);
  select_items(mesh.tangents, sources);
  for (auto& uvs : mesh.uvs) select_items(uvs, sources);
  select_items(mesh.colors, sources);
  for (MorphTarget& target : mesh.targets) {
    select_items(target.positions, sources);
    select_items(target.normals, sources);
    select_items(target.tangents, sources);
  }
  select_items(mesh.joints, sources);
  select_items(mesh.weights, sources);
  select_items(mesh.more_joints, sources);
  select_items(mesh.more_weights, sources);
}

std::vector<uint32_t> compact_indices(std::vector<uint32_t>& indices, std::size_t count) {
  if (indices.size() < count / 8) return compact_by_sorting(indices);
  std::vector<uint32_t> numbers(count, 0);
  for (const uint32_t index : indices) numbers[index] = 1;
  const auto used_count = static_cast<std::size_t>(std::ranges::count(numbers, 1u));
  std::vector<uint32_t> used;
  if (used_count == count) return used;
  used.reserve(used_count);
  for (uint32_t i = 0; i < count; ++i) {
    if (numbers[i] == 0) continue;
    numbers[i] = static_cast<uint32_t>(used.size());
    used.push_back(i);
  }
  for (uint32_t& index : indices) index = numbers[index];
  return used;
}

void remove_unused_vertices(ModelMesh& mesh) {
  if (mesh.indices.empty()) return;
  const std::vector<uint32_t> used = compact_indices(mesh.indices, mesh.positions.size());
  if (!used.empty()) copy_vertices(mesh, used);
}

}  // namespace halfspace::HS_LANES
