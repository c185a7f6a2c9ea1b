// SPDX-License-Identifier: Apache-2.0
//
// A surface that can be evaluated at any point of the unit square.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A vertex of a surface, in object space. Normals and tangents are those of Mesh.
struct SurfaceVertex {
  glm::vec3 position, normal;
  glm::vec4 tangent;
};

/// A surface over (u, v) in [0, 1]². Results depend only on (u, v), bit for bit. Functions can be called from any thread.
class ParametricSurface {
 public:
  virtual ~ParametricSurface() = default;
  virtual SurfaceVertex at(double u, double v) const = 0;
  /// Computes the positions of at() at all pairs of u and v, row by row; one row per v.
  virtual void positions(std::span<const double> u, std::span<const double> v, std::span<glm::vec3> out) const = 0;
};

}  // namespace halfspace::HS_LANES
