// SPDX-License-Identifier: Apache-2.0
//
// Shapes from formulas, computed in double without libm and rounded to float once: the same bits on every machine.
// All are y up, wound counter-clockwise seen from outside, with outward unit normals, texture coordinates and tangents. What is
// closed has equal position bits where two faces, or the two ends of a map, meet. `displacement`, where it is given, lays heights
// on the surface (geometry/surface_mesh.h); it stays closed, whatever the map holds.
#pragma once

#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/surface_mesh.h"

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

/// A sphere round the origin from the icosahedron with corners at the poles, each triangle divided into 4^level ones and its
/// corners moved to the sphere: 20 · 4^level triangles of nearly one size; level ≥ 0. Formula and map are uv_sphere's. A
/// triangle over the seam has u above 1, never a jump back; one at a pole has its own vertex there, u between the two others.
/// Field edges: sphere; a pole has one height, the mean of its vertices'.
Mesh icosphere(int level, float radius, const Displacement* displacement = nullptr);

/// A closed cylinder round the y axis, y from −length/2 to length/2. Side of `bands` ≥ 1 rows and `sectors` ≥ 3 columns:
///
///   P(u, v) = (r cos 2πu, length · (1/2 − v), −r sin 2πu)
///
/// The caps show the disc within the map: from above u grows along +x and v along +z; from below v along −z. They have
/// `bands` rings. Field edges: cylinder; heights fade to zero towards the rims, within kFadeWidth of v and of the radius.
Mesh cylinder(float radius, float length, int bands, int sectors, const Displacement* displacement = nullptr);

/// A closed cone round the y axis with its apex at y = length/2 and its base, a cap as the cylinder's lower one, at −length/2:
///
///   P(u, v) = (v r cos 2πu, length · (1/2 − v), −v r sin 2πu)
///
/// The apex has one vertex a sector, at its middle. Field edges: cylinder; heights fade to zero towards apex and rim.
Mesh cone(float radius, float length, int bands, int sectors, const Displacement* displacement = nullptr);

/// A ring round the y axis, `bands` ≥ 3 rows round its tube and `sectors` ≥ 3 columns round the axis; the tube's middle is
/// `radius` from the axis, tube < radius:
///
///   P(u, v) = ((R − t cos 2πv) cos 2πu, t sin 2πv, −(R − t cos 2πv) sin 2πu)
///
/// v = 0 is the inmost circle, 1/4 the uppermost, 1/2 the outmost. Field edges: torus.
Mesh torus(float radius, float tube, int bands, int sectors, const Displacement* displacement = nullptr);

/// A tube along a trefoil knot on a torus round the y axis: `bands` ≥ 3 rows round the tube, `sectors` ≥ 3 columns along the
/// knot, which runs twice round the axis, at `radius` on the mean. tube below a quarter of the radius keeps clear of itself.
/// Its formula stands in torus_knot.cpp. Field edges: torus.
Mesh torus_knot(float radius, float tube, int bands, int sectors, const Displacement* displacement = nullptr);

/// A square in the plane y = 0 with corners at ±size/2, facing up, of segments² squares; u grows along +x, v along +z. Field
/// edges: sheet.
Mesh plane(float size, int segments = 1, const Displacement* displacement = nullptr);

/// An axis-aligned cube round the origin with edges of length `size`, every face of segments² squares with the whole of
/// [0, 1]² as its texture coordinates. Field edges: sheet; heights fade to zero towards the edges, within kFadeWidth of a face.
Mesh cube(float size, int segments = 1, const Displacement* displacement = nullptr);

}  // namespace halfspace
