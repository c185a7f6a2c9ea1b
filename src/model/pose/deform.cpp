// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/deform.h"

#include <algorithm>
#include <cmath>

#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

// Rounds a position to float and clamps it to the range that files may use.
glm::vec3 rounded_position(const glm::dvec3& p) { return glm::vec3(glm::clamp(p, -kMaxModelNumber, kMaxModelNumber)); }

// Returns v normalized, or the fallback if v is 0 or NaN.
glm::vec3 unit_or(const glm::dvec3& v, const glm::vec3& fallback) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0.0)) return fallback;
  const glm::dvec3 scaled = v / size;
  return glm::vec3(scaled / std::sqrt(glm::dot(scaled, scaled)));
}

// Returns base[i] + Σ weight · list(target)[i] over all targets that have this list.
template <class List>
glm::dvec3 morphed(const ModelMesh& mesh, std::span<const float> weights, const glm::vec3& base, std::size_t i, List list) {
  glm::dvec3 value(base);
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const std::vector<glm::vec3>& offsets = list(mesh.targets[t]);
    if (!offsets.empty() && weights[t] != 0.0f) value += static_cast<double>(weights[t]) * glm::dvec3(offsets[i]);
  }
  return value;
}

/// Columns of the upper 3×4 part of a matrix.
struct Affine {
  glm::dvec3 x{0.0}, y{0.0}, z{0.0}, translation{0.0};

  void add(double weight, const glm::dmat4& m) {
    x += weight * glm::dvec3(m[0]);
    y += weight * glm::dvec3(m[1]);
    z += weight * glm::dvec3(m[2]);
    translation += weight * glm::dvec3(m[3]);
  }
  glm::dvec3 direction(const glm::dvec3& v) const { return x * v.x + y * v.y + z * v.z; }
  /// Applies the inverse transpose, scaled by the absolute value of the determinant.
  glm::dvec3 normal(const glm::dvec3& n) const {
    const glm::dvec3 yz = glm::cross(y, z);
    const glm::dvec3 v = yz * n.x + glm::cross(z, x) * n.y + glm::cross(x, y) * n.z;
    return glm::dot(x, yz) < 0.0 ? -v : v;
  }
  bool mirrors() const { return glm::dot(x, glm::cross(y, z)) < 0.0; }
};

}  // namespace

void apply_morph_targets(ModelMesh& mesh, std::span<const float> weights) {
  weights = weights.first(std::min(weights.size(), mesh.targets.size()));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions[i] = rounded_position(morphed(
        mesh, weights, mesh.positions[i], i, [](const MorphTarget& t) -> const auto& { return t.positions; }));
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    glm::vec3& n = mesh.normals[i];
    n = unit_or(morphed(
                    mesh, weights, n, i, [](const MorphTarget& t) -> const auto& { return t.normals; }),
                n);
  }
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    glm::vec4& tangent = mesh.tangents[i];
    const glm::vec3 direction(tangent);
    tangent = glm::vec4(unit_or(morphed(
                                    mesh, weights, direction, i, [](const MorphTarget& t) -> const auto& { return t.tangents; }),
                                direction),
                        tangent.w);
  }
}

void apply_skin(ModelMesh& mesh, std::span<const glm::dmat4> joint_matrices) {
  const auto add_joints = [&](Affine& blend, const std::array<uint16_t, 4>& joints, const glm::vec4& weights) {
    for (int k = 0; k < 4; ++k) {
      if (weights[k] != 0.0f) blend.add(static_cast<double>(weights[k]), joint_matrices[joints[static_cast<std::size_t>(k)]]);
    }
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Affine blend;
    add_joints(blend, mesh.joints[i], mesh.weights[i]);
    if (!mesh.more_joints.empty()) add_joints(blend, mesh.more_joints[i], mesh.more_weights[i]);
    mesh.positions[i] = rounded_position(blend.direction(mesh.origin + glm::dvec3(mesh.positions[i])) + blend.translation);
    if (!mesh.normals.empty()) mesh.normals[i] = unit_or(blend.normal(glm::dvec3(mesh.normals[i])), mesh.normals[i]);
    if (!mesh.tangents.empty()) {
      glm::vec4& t = mesh.tangents[i];
      const glm::vec3 direction = unit_or(blend.direction(glm::dvec3(glm::vec3(t))), glm::vec3(t));
      t = glm::vec4(direction, blend.mirrors() ? -t.w : t.w);
    }
  }
  mesh.origin = glm::dvec3(0.0);
}

}  // namespace halfspace::HS_LANES
