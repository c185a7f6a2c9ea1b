// SPDX-License-Identifier: Apache-2.0
//
// Spheres as an eye or a light sees them. In: the transform to clip space. Out: the lens, and the centres in its axes.
#pragma once

#include <vector>

#include "halfspace/render/particles.h"
#include "halfspace/shading/sphere_intersection.h"

namespace halfspace {

class SphereCamera {
 public:
  /// clip_from_world: reversed Z in [0, w], without skew; near, far: where its depth is 1 and 0, units along the axis.
  SphereCamera(const glm::dmat4& clip_from_world, double near, double far);

  SphereIntersection lens(const glm::ivec2& size_px) const { return {perspective_, half_, near_, far_, size_px}; }
  /// In the camera's axes, as SphereIntersection has them.
  std::vector<glm::vec3> centers_cs(const Particles& spheres) const;

 private:
  glm::dmat4 clip_from_world_;
  bool perspective_;
  glm::dvec2 half_;  // tangents, or units
  double near_, far_;
};

}  // namespace halfspace
