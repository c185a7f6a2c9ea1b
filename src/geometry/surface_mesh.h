// SPDX-License-Identifier: Apache-2.0
//
// From a surface in closed form to a mesh, displaced along its normal or not: every generator but uv_sphere gives the points
// of its surface with their derivatives, and this makes vertices of them, in double and rounded to float once.
//
// With the height g(u, v) the displaced surface is P' = P + n·g, so
//
//   P'u = Pu + nu·g + n·gu      P'v = Pv + nv·g + n·gv      normal = normalize(P'v × P'u)
//
// (v grows downwards in a map, so that Pv × Pu points outward.) The tangent is P'u's direction, and cross(normal, tangent) is
// what of −P'v is at right angles to it.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"

namespace halfspace {

/// Heights to be laid on a shape: g = scale · (h(u, v) − zero), in the shape's unit, positive outwards. The field's edges
/// must be those that the shape names; give it filtered to the tessellation.
struct Displacement {
  const HeightField* field;
  double scale, zero;
};

/// A number that depends on (u, v), with its derivatives.
struct Fade {
  double value = 1.0, du = 0.0, dv = 0.0;
};

/// How wide a fade is, in parts of the map.
inline constexpr double kFadeWidth = 0.125;

/// 0 at x = 0, 1 from kFadeWidth on, smooth (3s² − 2s³) between; and its derivative. x ≥ 0.
struct FadeStep {
  double value, slope;
};
FadeStep fade_in(double x);

/// One point of a surface.
struct MeshPoint {
  glm::dvec2 uv;
  glm::dvec3 position, du, dv;              ///< P, ∂P/∂u, ∂P/∂v
  glm::dvec3 normal, normal_du, normal_dv;  ///< n and its derivatives
  glm::dvec3 tangent{1, 0, 0};              ///< unit vector, where ∂P/∂u is zero: at a pole
  Fade fade{};                              ///< factor of g: zero where faces meet at an edge, so that no crack opens there
};

/// Collects the vertices and triangles of a surface.
class SurfaceMesh {
 public:
  /// displacement: null for none.
  explicit SurfaceMesh(const Displacement* displacement) : displacement_(displacement) {}

  double height_at(const MeshPoint& p) const;

  /// Adds a vertex and returns its index.
  int add(const MeshPoint& p);
  /// Adds a vertex where ∂P/∂u is zero, at the height g: it keeps the normal and the tangent of the undisplaced surface.
  int add_pole(const MeshPoint& p, double g);
  /// Adds a triangle, counter-clockwise seen from outside.
  void add_triangle(int a, int b, int c);
  /// Adds the triangles of (columns + 1) x (rows + 1) vertices from `first` on, row by row, row 0 at the top of the map.
  void add_grid(int first, int columns, int rows);

  Mesh take() { return std::move(mesh_); }

 private:
  int add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent, const glm::dvec2& uv);

  const Displacement* displacement_;
  Mesh mesh_;
};

}  // namespace halfspace
