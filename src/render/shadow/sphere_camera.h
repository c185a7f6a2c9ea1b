// SPDX-License-Identifier: Apache-2.0
//
// Projects spheres as seen from a camera or a light with a given transform to clip space.
#pragma once

#include <vector>

#include "halfspace/render/particles.h"
#include "halfspace/shading/sphere/sphere_intersection.h"

namespace halfspace::HS_LANES {

class SphereCamera {
 public:
  /// clip_from_world must use reversed Z in [0, w] and have no skew. near and far are the distances along the axis with depth 1 and
  /// 0.
  SphereCamera(const glm::dmat4& clip_from_world, double near, double far);

  SphereIntersection lens(const glm::ivec2& size_px) const { return {perspective_, half_, near_, far_, size_px}; }
  /// Returns the centers in the camera's axes, as SphereIntersection expects them.
  std::vector<glm::vec3> centers_cs(const Particles& spheres) const;

 private:
  glm::dmat4 clip_from_world_;
  bool perspective_;
  glm::dvec2 half_;  // half the view's size, as tangents (perspective) or in units (orthographic)
  double near_, far_;
};

}  // namespace halfspace::HS_LANES
