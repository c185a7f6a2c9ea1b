// SPDX-License-Identifier: Apache-2.0
//
// A uv_sphere displaced along its normals by a height field, and slope maps of the displaced surface for per-pixel normals.
// Everything is computed in double without libm and rounded to float once.
//
// Notation: P = r·n is the point of uv_sphere, e and m are the unit vectors to the east and north, s = sin πv, and g(u, v) =
// height_scale · (h(u, v) − zero_level) is the height. The displaced surface is P' = (r + g)·n. The derivatives of n are 2πs·e with
// respect to u and −π·m with respect to v, so
//
//   P'u = (r + g)·2πs·e + gu·n        P'v = −(r + g)·π·m + gv·n
//   P'v × P'u = 2π²·s·r·(r + g) · [ (1 + g/r)·n − gu/(2πrs)·e + gv/(πr)·m ]       (m × e = −n, m × n = e, n × e = m)
//
// The factor before the bracket is positive between the poles, so the vector points outward. With the slopes towards the east and north,
// measured on the undisplaced sphere, g_east = gu/(2πrs) and g_north = −gv/(πr),
//
//   normal = normalize( (1 + g/r)·n − g_east·e − g_north·m ).
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/parametric_surface.h"

namespace halfspace::HS_LANES {

/// Whether the vertex normals of a displaced sphere are computed from the displaced surface or, for comparison, the undisplaced sphere.
enum class ReliefNormals { displaced, undisplaced };

/// Returns the mesh of uv_sphere displaced by g. Vertices, texture coordinates and triangles have the same order. g is in the units of
/// `radius`, and r + g must stay positive. Normals are computed from the smooth surface; tangents point along P'u. Each pole has a single
/// height, the mean over its vertices, and keeps the tangent frame of the sphere. Positions and normals on both sides of the seam are
/// bit-identical. The field should be filtered to `longitudes` columns.
Mesh displaced_uv_sphere(int latitudes, int longitudes, float radius, const HeightField& field, double height_scale, double zero_level,
                         const Workers& workers, ReliefNormals normals = ReliefNormals::displaced);

/// The surface of uv_sphere or displaced_uv_sphere at any resolution. (u, v) are the coordinates of uv_sphere. At a pole, u determines the
/// tangent frame, and the height is the mean over the columns of the field.
class SphereSurface : public ParametricSurface {
 public:
  /// field: null if the sphere is not displaced; otherwise it must outlive this object. radius > 0, and r + g must stay positive.
  SphereSurface(const HeightField* field, double radius, double height_scale, double zero_level,
                ReliefNormals normals = ReliefNormals::displaced);
  SurfaceVertex at(double u, double v) const override;
  void positions(std::span<const double> u, std::span<const double> v, std::span<glm::vec3> out) const override;

 private:
  double distance_at(double u, double v) const;

  const HeightField* field_;
  double radius_, height_scale_, zero_level_;
  ReliefNormals normals_;
  double north_, south_;  ///< distances of the poles from the center
};

/// Computes an equirectangular map of (g_east, g_north, 1 + g/r, 0) at the texel centers, with the terms of the formula above.
/// Slopes are dimensionless, positive where the ground rises towards the east or north. Pass a field filtered to `width`; it must
/// outlive this object. width, height ≥ 1, radius > 0. Rows can be computed concurrently from any number of threads.
class SlopeRows {
 public:
  SlopeRows(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level);
  /// slopes: one value per column of the map.
  void operator()(int row, std::span<glm::vec4> slopes) const;

 private:
  const HeightField& field_;
  int height_;
  double radius_, height_scale_, zero_level_;
  bool at_texels_;                ///< the map and the field have the same texel grid
  std::vector<HeightTaps> taps_;  ///< one per column; empty if at_texels_
};
/// Returns all rows as an image.
Image<glm::vec4> slope_map(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level,
                           const Workers& workers);

/// Returns (g_east, g_north, 1 + g/r) at (u, v), 0 < v < 1.
glm::dvec3 slopes_at(const HeightField& field, double u, double v, double radius, double height_scale, double zero_level);

}  // namespace halfspace::HS_LANES
