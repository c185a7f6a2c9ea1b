// SPDX-License-Identifier: Apache-2.0
#include "scenes/mesh_order.h"

#include <algorithm>
#include <array>
#include <limits>

namespace halfspace {

namespace {

constexpr int kBits = 6;  // of a cell's coordinate

uint32_t morton_code(glm::uvec3 cell) {
  uint32_t code = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    for (int axis = 0; axis < 3; ++axis) code |= ((cell[axis] >> bit) & 1u) << (3 * bit + axis);
  }
  return code;
}

struct CodedTriangle {
  uint32_t code;
  std::array<uint32_t, 3> corners;
};

std::vector<CodedTriangle> coded_triangles(const SceneShape& shape) {
  glm::vec3 low(shape.vertices.front().position), high = low;
  for (const SceneVertex& v : shape.vertices) {
    low = glm::min(low, v.position);
    high = glm::max(high, v.position);
  }
  const glm::vec3 size = high - low;
  const float widest = std::max({size.x, size.y, size.z});
  std::vector<CodedTriangle> triangles;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const std::array<uint32_t, 3> corners{shape.indices[i], shape.indices[i + 1], shape.indices[i + 2]};
    glm::vec3 sum(0.0f);
    for (const uint32_t corner : corners) sum += shape.vertices[corner].position - low;
    const glm::uvec3 cell(sum * (static_cast<float>(1 << kBits) / (3.0f * widest)));
    triangles.push_back({morton_code(glm::min(cell, glm::uvec3((1u << kBits) - 1))), corners});
  }
  return triangles;
}

}  // namespace

void order_by_cells(SceneShape& shape) {
  std::vector<CodedTriangle> triangles = coded_triangles(shape);
  std::ranges::stable_sort(triangles, {}, &CodedTriangle::code);
  constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> new_index(shape.vertices.size(), kUnused);
  SceneShape ordered;
  ordered.vertices.reserve(shape.vertices.size());
  ordered.indices.reserve(shape.indices.size());
  for (const CodedTriangle& triangle : triangles) {
    for (const uint32_t corner : triangle.corners) {
      if (new_index[corner] == kUnused) {
        new_index[corner] = static_cast<uint32_t>(ordered.vertices.size());
        ordered.vertices.push_back(shape.vertices[corner]);
      }
      ordered.indices.push_back(new_index[corner]);
    }
  }
  shape = std::move(ordered);
}

}  // namespace halfspace
