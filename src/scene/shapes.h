// SPDX-License-Identifier: Apache-2.0
//
// Shapes from formulas, computed in double without libm and rounded to float once: the same bits on every machine.
// All are y up, wound counter-clockwise seen from outside, with outward unit normals, texture coordinates and tangents.
#pragma once

#include "core/trig_double.h"
#include "scene/mesh.h"

namespace halfspace {

/// A sphere round the origin of `latitudes` ≥ 2 bands and `longitudes` ≥ 3 sectors:
///
///   P(u, v) = r · (sin πv · cos 2πu, cos πv, −sin πv · sin 2πu)
///
/// v = 0 is the north pole (+y, top row of a map) and u grows eastwards, so a map whose left edge is 180° W reads the
/// right way round from outside, with that meridian at +x. The seam is closed by vertices at u = 0 and u = 1 with
/// equal positions. A pole has one vertex per sector, u at the sector's middle, so the map does not swirl there.
/// Triangles: 2 · longitudes · (latitudes − 1), none degenerate.
Mesh uv_sphere(int latitudes, int longitudes, float radius);

/// Row i of uv_sphere's vertices, from 0 at the north pole to `latitudes` at the south pole: its vertices are the mesh's
/// from `first` on, at v and at u(0), u(1), …
struct SphereRow {
  int first, count, longitudes;
  double v;
  bool is_pole;

  double u(int j) const { return (j + (is_pole ? 0.5 : 0.0)) / longitudes; }
};
SphereRow uv_sphere_row(int i, int latitudes, int longitudes);

/// Unit vectors at a place of uv_sphere, right-handed in this order; at a pole by the given longitude:
///
///   east = (−sin 2πu, 0, −cos 2πu), north = (−cos πv · cos 2πu, sin πv, cos πv · sin 2πu), normal = P / r
///
/// P's derivatives are 2πr · sin πv · east by u and −πr · north by v.
struct SphereFrame {
  glm::dvec3 east, north, normal;
};
SphereFrame sphere_frame(const SinCosDouble& two_pi_u, const SinCosDouble& pi_v);

/// A square in the plane y = 0 with corners at ±size/2, facing up; u grows along +x, v along +z. Two triangles.
Mesh plane(float size);

/// An axis-aligned cube round the origin with edges of length `size`: 24 vertices, every face with the whole of
/// [0, 1]² as its texture coordinates. Twelve triangles.
Mesh cube(float size);

}  // namespace halfspace
