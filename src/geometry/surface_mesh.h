// SPDX-License-Identifier: Apache-2.0
//
// Builds a mesh from a closed-form surface, optionally displaced along its normal. All generators except uv_sphere pass points of
// their surface with derivatives to SurfaceMesh. Vertices are computed in double and rounded to float once.
//
// With the height g(u, v), the displaced surface is P' = P + n·g, so
//
//   P'u = Pu + nu·g + n·gu      P'v = Pv + nv·g + n·gv      normal = normalize(P'v × P'u)
//
// v grows downwards in a map, so Pv × Pu points outward. The tangent is the direction of P'u, and cross(normal, tangent) is the
// direction of the component of −P'v perpendicular to it.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/parametric_surface.h"

namespace halfspace::HS_LANES {

/// Heights that displace a shape: g = scale · (h(u, v) − zero), in the unit of the shape, positive outwards. The field must have
/// the edge mode documented for the shape and be filtered to the tessellation.
struct Displacement {
  const HeightField* field;
  double scale, zero;
};

/// A scalar function of (u, v) with its derivatives.
struct Fade {
  double value = 1.0, du = 0.0, dv = 0.0;
};

/// Width of a fade, as a fraction of the map.
inline constexpr double kFadeWidth = 0.125;

/// Smooth step 3s² − 2s³ from 0 at x = 0 to 1 at x ≥ kFadeWidth, and its derivative. x ≥ 0.
struct FadeStep {
  double value, slope;
};
FadeStep fade_in(double x);

/// One point of a surface.
struct MeshPoint {
  glm::dvec2 uv;
  glm::dvec3 position, du, dv;              ///< P, ∂P/∂u, ∂P/∂v
  glm::dvec3 normal, normal_du, normal_dv;  ///< n and its derivatives
  glm::dvec3 tangent{1, 0, 0};              ///< unit tangent for points where ∂P/∂u is zero, such as poles
  Fade fade{};                              ///< factor of g; zero at edges between faces, so that no cracks open there
};

/// Returns a vertex of a surface, displaced if displacement is not null.
SurfaceVertex vertex_of(const MeshPoint& p, const Displacement* displacement);

/// Collects the vertices and triangles of a surface.
class SurfaceMesh {
 public:
  /// `displacement` may be null.
  explicit SurfaceMesh(const Displacement* displacement) : displacement_(displacement) {}

  double height_at(const MeshPoint& p) const;

  /// Adds a vertex and returns its index.
  int add(const MeshPoint& p);
  /// Adds a vertex displaced by g where ∂P/∂u is zero. It keeps the normal and the tangent of the undisplaced surface.
  int add_pole(const MeshPoint& p, double g);
  /// Adds a triangle, counter-clockwise seen from outside.
  void add_triangle(int a, int b, int c);
  /// Adds the triangles of a grid of (columns + 1) x (rows + 1) vertices that starts at vertex `first`, row 0 at the top of the
  /// map.
  void add_grid(int first, int columns, int rows);

  Mesh take() { return std::move(mesh_); }

 private:
  int add_vertex(const SurfaceVertex& vertex, const glm::dvec2& uv);

  const Displacement* displacement_;
  Mesh mesh_;
};

}  // namespace halfspace::HS_LANES
