// SPDX-License-Identifier: Apache-2.0
//
// A parametric surface from a function that returns its points, displaced or not.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "halfspace/geometry/parametric_surface.h"
#include "halfspace/geometry/surface_mesh.h"

namespace halfspace::HS_LANES {

class PointSurface : public ParametricSurface {
 public:
  /// point: a pure function, for example torus_point with its radii; it must be able to run on several threads. displacement: its field
  /// must outlive this object.
  PointSurface(std::function<MeshPoint(double u, double v)> point, std::optional<Displacement> displacement)
      : point_(std::move(point)), displacement_(displacement) {}

  SurfaceVertex at(double u, double v) const override { return vertex_of(point_(u, v), displacement_ ? &*displacement_ : nullptr); }

  void positions(std::span<const double> u, std::span<const double> v, std::span<glm::vec3> out) const override {
    for (std::size_t j = 0; j < v.size(); ++j) {
      for (std::size_t i = 0; i < u.size(); ++i) out[j * u.size() + i] = at(u[i], v[j]).position;
    }
  }

 private:
  std::function<MeshPoint(double u, double v)> point_;
  std::optional<Displacement> displacement_;
};

}  // namespace halfspace::HS_LANES
