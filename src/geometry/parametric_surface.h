// SPDX-License-Identifier: Apache-2.0
//
// A surface that can be evaluated at any point of the unit square.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A vertex of a surface, in object space. Normals and tangents are those of Mesh.
struct SurfaceVertex {
  glm::vec3 position, normal;
  glm::vec4 tangent;
};

/// A surface over (u, v) in [0, 1]². Results depend only on the arguments, bit for bit. Functions can be called from any thread.
class ParametricSurface {
 public:
  virtual ~ParametricSurface() = default;
  virtual SurfaceVertex at(double u, double v) const = 0;
};

}  // namespace halfspace::HS_LANES
