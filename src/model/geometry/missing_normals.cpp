// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "halfspace/model/geometry/normals.h"

namespace halfspace::HS_LANES {

std::size_t replace_missing_normals(ModelMesh& mesh) {
  std::vector<uint32_t> number(mesh.normals.size(), 0);  // of the missing normal, counted from 1
  std::vector<glm::dvec3> sums;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (mesh.normals[i] != glm::vec3(0.0f)) continue;
    sums.emplace_back(0.0);
    number[i] = static_cast<uint32_t>(sums.size());
  }
  if (sums.empty()) return 0;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]), c(mesh.positions[mesh.indices[t + 2]]);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) {
      if (const uint32_t n = number[mesh.indices[t + k]]; n > 0) sums[n - 1] += area;
    }
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (number[i] == 0) continue;
    const glm::dvec3& sum = sums[number[i] - 1];
    const double length = std::sqrt(glm::dot(sum, sum));
    mesh.normals[i] = length > 0.0 && std::isfinite(length) ? unit_vector(sum) : glm::vec3(0.0f, 1.0f, 0.0f);
  }
  return sums.size();
}

}  // namespace halfspace::HS_LANES
