// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_indices.h"

namespace halfspace::HS_LANES {

namespace {

std::vector<uint32_t> lines_of_strip(const std::vector<uint32_t>& strip, bool closed) {
  std::vector<uint32_t> list;
  if (strip.size() < 2) return list;
  for (std::size_t i = 0; i + 1 < strip.size(); ++i) list.insert(list.end(), {strip[i], strip[i + 1]});
  if (closed) list.insert(list.end(), {strip.back(), strip.front()});
  return list;
}

// Every second triangle of a strip has the opposite winding.
std::vector<uint32_t> triangles_of_strip(const std::vector<uint32_t>& strip) {
  std::vector<uint32_t> list;
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    list.insert(list.end(), {strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2]});
  }
  return list;
}

std::vector<uint32_t> triangles_of_fan(const std::vector<uint32_t>& fan) {
  std::vector<uint32_t> list;
  for (std::size_t i = 0; i + 2 < fan.size(); ++i) list.insert(list.end(), {fan[i + 1], fan[i + 2], fan[0]});
  return list;
}

}  // namespace

MeshTopology topology_of(GltfMode mode) {
  switch (mode) {
    case GltfMode::points: return MeshTopology::points;
    case GltfMode::lines:
    case GltfMode::line_loop:
    case GltfMode::line_strip: return MeshTopology::lines;
    default: return MeshTopology::triangles;
  }
}

std::vector<uint32_t> list_of_primitives(GltfMode mode, std::vector<uint32_t> indices) {
  switch (mode) {
    case GltfMode::points: break;
    case GltfMode::lines: indices.resize(indices.size() / 2 * 2); break;
    case GltfMode::line_loop: return lines_of_strip(indices, true);
    case GltfMode::line_strip: return lines_of_strip(indices, false);
    case GltfMode::triangles: indices.resize(indices.size() / 3 * 3); break;
    case GltfMode::triangle_strip: return triangles_of_strip(indices);
    case GltfMode::triangle_fan: return triangles_of_fan(indices);
  }
  return indices;
}

}  // namespace halfspace::HS_LANES
