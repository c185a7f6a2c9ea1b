// SPDX-License-Identifier: Apache-2.0
//
// What a vertex function computes in the bounding boxes of clusters: linear functions of the position, with bounds of their rounding
// errors.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/clusters.h"
#include "halfspace/raster/draw_state.h"

namespace halfspace::HS_LANES {

/// Bound of the rounding errors of a clip-space coordinate, as a part of the sum of the absolute values of its terms: 32 roundings of
/// 2^-24. The shader may make 16 (ClusterCulling), and the computations of the culling make fewer than 16.
inline constexpr float kError = 0x1p-19f;

/// A linear function a·x + b·y + c·z + d of the position.
struct Plane {
  glm::vec3 normal, size;  ///< size: absolute values of normal
  float offset;
};
inline Plane plane_of(const glm::dvec4& p) {
  const glm::vec3 normal(p);
  return {normal, glm::abs(normal), static_cast<float>(p.w)};
}

/// The bounding boxes of W clusters.
struct Boxes {
  std::array<Real, 3> center, half, largest;  ///< largest: absolute value of a coordinate
};

inline Boxes load_boxes(const Clusters& clusters, std::size_t first) {
  Boxes out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real low = load<Real>(clusters.values(static_cast<Clusters::Value>(Clusters::kLowX + k)) + first);
    const Real high = load<Real>(clusters.values(static_cast<Clusters::Value>(Clusters::kHighX + k)) + first);
    out.center[k] = Real(0.5f) * low + Real(0.5f) * high;
    out.half[k] = Real(0.5f) * high - Real(0.5f) * low;
    out.largest[k] = max(abs(low), abs(high));
  }
  return out;
}

inline Real dot(const glm::vec3& a, const std::array<Real, 3>& b) { return Real(a.x) * b[0] + Real(a.y) * b[1] + Real(a.z) * b[2]; }

/// A value that a shader computes: a linear function, and the sums of the absolute values of the products in its factors.
struct Computed {
  Plane plane, sums;
};
/// Returns a bound of the rounding errors of a value in W boxes, those of a shader and of the code that culls clusters.
inline Real error_bound(const Computed& v, const Boxes& b) { return Real(kError) * (dot(v.sums.normal, b.largest) + Real(v.sums.offset)); }

/// The values of a function in W boxes: [middle − radius, middle + radius]. radius includes rounding errors.
struct Interval {
  Real middle, radius;
  Real low() const { return middle - radius; }
  Real high() const { return middle + radius; }
};
inline Interval interval(const Computed& v, const Boxes& b) {
  return {dot(v.plane.normal, b.center) + Real(v.plane.offset), dot(v.plane.size, b.half) + error_bound(v, b)};
}

/// The transform from object space to clip space.
struct ClipTransform {
  glm::dmat4 rows;  ///< column k has the factors of clip-space coordinate k
  glm::dmat4 sums;  ///< for each factor, the sum of the absolute values of its products

  explicit ClipTransform(const ClusterCulling& culling) {
    const glm::dmat4 outer(culling.clip_from_world), inner(culling.world_from_object);
    const auto absolute = [](const glm::dmat4& m) { return glm::dmat4(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2]), glm::abs(m[3])); };
    rows = glm::transpose(outer * inner);
    sums = glm::transpose(absolute(outer) * absolute(inner));
  }
  /// Returns clip-space coordinate k.
  Computed computed(int k) const { return {plane_of(rows[k]), plane_of(sums[k])}; }
};

}  // namespace halfspace::HS_LANES
