// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/node_transform.h"

#include <algorithm>
#include <cmath>

#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

glm::dquat unit_rotation(const glm::dquat& q) {
  // Scale first, so that squares neither overflow nor underflow.
  const double size = std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  if (!(size > 0.0)) return {1.0, 0.0, 0.0, 0.0};
  const glm::dquat s(q.w / size, q.x / size, q.y / size, q.z / size);
  const double length = std::sqrt(s.w * s.w + s.x * s.x + s.y * s.y + s.z * s.z);
  return {s.w / length, s.x / length, s.y / length, s.z / length};
}

glm::dmat4 matrix_of(const NodeTransform& t) {
  const glm::dmat3 r = glm::mat3_cast(t.rotation);
  return {glm::dvec4(r[0] * t.scale.x, 0.0), glm::dvec4(r[1] * t.scale.y, 0.0), glm::dvec4(r[2] * t.scale.z, 0.0),
          glm::dvec4(t.translation, 1.0)};
}

glm::dmat4 matrix_of(const ModelNode& node) { return node.matrix ? *node.matrix : matrix_of(node.transform); }

bool is_bounded_transform(const glm::dmat4& m) {
  for (glm::length_t column = 0; column < 4; ++column) {
    for (glm::length_t row = 0; row < 4; ++row) {
      if (!(std::abs(m[column][row]) <= kMaxModelNumber)) return false;
    }
  }
  return true;
}

}  // namespace halfspace::HS_LANES
