// SPDX-License-Identifier: Apache-2.0
//
// uv_sphere with a height field along its normals, and the slopes of that surface for normals by pixel. All is computed
// in double without libm and rounded to float once.
//
// With P = r·n of uv_sphere, e and m the units to the east and north, s = sin πv and the height g(u, v) = height_scale ·
// (h(u, v) − zero_level), the surface is P' = (r + g)·n. As n's derivatives are 2πs·e by u and −π·m by v,
//
//   P'u = (r + g)·2πs·e + gu·n        P'v = −(r + g)·π·m + gv·n
//   P'v × P'u = 2π²·s·r·(r + g) · [ (1 + g/r)·n − gu/(2πrs)·e + gv/(πr)·m ]       (m × e = −n, m × n = e, n × e = m)
//
// so with the slopes to the east and north measured on the undisplaced sphere, g_east = gu/(2πrs), g_north = −gv/(πr),
//
//   normal = normalize( (1 + g/r)·n − g_east·e − g_north·m ),
//
// and the factor before the bracket is positive between the poles: it points outward.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"

namespace halfspace {

/// Which normals a displaced sphere gets: its own, or those of the sphere below it (to show what they are worth).
enum class ReliefNormals { displaced, undisplaced };

/// The mesh of uv_sphere (its vertices, texture coordinates and triangles in its order), displaced by g in the unit of
/// `radius`; r + g must stay positive. The normals are those of the smooth surface, tangents run along P'u. A pole has one
/// height, the mean of its vertices', and the sphere's frame. The seam has equal positions and normals on both sides, bit
/// for bit. Give it a field filtered to `longitudes`.
Mesh displaced_uv_sphere(int latitudes, int longitudes, float radius, const HeightField& field, double height_scale, double zero_level,
                         const Workers& workers, ReliefNormals normals = ReliefNormals::displaced);

/// An equirectangular map of (g_east, g_north, 1 + g/r, 0) at the texels' centres, the numbers of the formula above:
/// slopes are lengths per length, positive where the ground rises towards the east or north. Give it a field filtered to
/// `width`. width, height ≥ 1, radius > 0. Row by row, by any number of threads at once; it keeps a reference to the field.
class SlopeRows {
 public:
  SlopeRows(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level);
  /// slopes: `width` of them.
  void operator()(int row, std::span<glm::vec4> slopes) const;

 private:
  const HeightField& field_;
  int height_;
  double radius_, height_scale_, zero_level_;
  bool at_texels_;                ///< the map's texels are the field's
  std::vector<HeightTaps> taps_;  ///< else
};
/// All rows.
Image<glm::vec4> slope_map(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level,
                           const Workers& workers);

/// The first three of them at (u, v), 0 < v < 1, in double.
glm::dvec3 slopes_at(const HeightField& field, double u, double v, double radius, double height_scale, double zero_level);

}  // namespace halfspace
