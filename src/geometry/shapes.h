// SPDX-License-Identifier: Apache-2.0
//
// Closed-form shapes, computed in double without libm and rounded to float once, so they are bit-identical on every machine. All
// shapes are y up and wound counter-clockwise seen from outside, with outward unit normals, texture coordinates and tangents. On
// closed shapes, positions are bit-identical where two faces, or opposite edges of the map, meet. `displacement`, if given,
// displaces the surface (geometry/surface_mesh.h); its field must use the MapEdges value given for each shape. A closed shape stays
// closed for any height map.
#pragma once

#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/surface_mesh.h"

namespace halfspace::HS_LANES {

/// A sphere around the origin with `latitudes` ≥ 2 bands and `longitudes` ≥ 3 sectors:
///
///   P(u, v) = r · (sin πv · cos 2πu, cos πv, −sin πv · sin 2πu)
///
/// v = 0 is the north pole (+y, the top row of a map) and u grows to the east. A map with its left edge at 180° W is not mirrored
/// when seen from outside, and that meridian is at +x. The seam is closed by vertices at u = 0 and u = 1 with equal positions. A
/// pole has one vertex per sector, with u at the middle of the sector, so the map does not swirl there. There are 2 · longitudes ·
/// (latitudes − 1) triangles, none of them degenerate.
Mesh uv_sphere(int latitudes, int longitudes, float radius);

/// Row i of the vertices of uv_sphere, from 0 at the north pole to `latitudes` at the south pole. Vertex first + j of the mesh is
/// at (u(j), v), for 0 ≤ j < count.
struct SphereRow {
  int first, count, longitudes;
  double v;
  bool is_pole;

  double u(int j) const { return (j + (is_pole ? 0.5 : 0.0)) / longitudes; }
};
SphereRow uv_sphere_row(int i, int latitudes, int longitudes);

/// Unit vectors at a point of uv_sphere, right-handed in this order. At a pole they depend on the longitude passed.
///
///   east = (−sin 2πu, 0, −cos 2πu), north = (−cos πv · cos 2πu, sin πv, cos πv · sin 2πu), normal = P / r
///
/// The derivatives of P are 2πr · sin πv · east with respect to u and −πr · north with respect to v.
struct SphereFrame {
  glm::dvec3 east, north, normal;
};
SphereFrame sphere_frame(const SinCosDouble& two_pi_u, const SinCosDouble& pi_v);

/// A sphere around the origin, subdivided from an icosahedron with vertices at the poles: 20 · 4^level triangles of nearly equal size;
/// level ≥ 0. The formula and the texture coordinates are those of uv_sphere. u exceeds 1 in triangles that cross the seam, so it never
/// jumps back. Each triangle at a pole has a separate vertex there, with u between the values at its other two vertices. All vertices at a
/// pole get the same height, the mean of their heights. A displacement field must use MapEdges::sphere.
Mesh icosphere(int level, float radius, const Displacement* displacement = nullptr);

/// A closed cylinder around the y axis, with y from −length/2 to length/2. The side has `bands` ≥ 1 rows and `sectors` ≥ 3 columns:
///
///   P(u, v) = (r cos 2πu, length · (1/2 − v), −r sin 2πu)
///
/// The caps show the disk inscribed in the map and have `bands` rings. u grows along +x; v grows along +z on the upper cap and
/// along −z on the lower cap. A displacement field must use MapEdges::cylinder. Heights fade to
/// zero towards the rims: over a range of kFadeWidth in v on the side, and over the outer kFadeWidth · radius of the caps.
Mesh cylinder(float radius, float length, int bands, int sectors, const Displacement* displacement = nullptr);

/// A closed cone around the y axis with its apex at y = length/2 and its base at −length/2, capped like the bottom of the cylinder:
///
///   P(u, v) = (v r cos 2πu, length · (1/2 − v), −v r sin 2πu)
///
/// The apex has one vertex per sector, with u at the middle of the sector. A displacement field must use MapEdges::cylinder.
/// Heights fade to zero towards the apex and the rim.
Mesh cone(float radius, float length, int bands, int sectors, const Displacement* displacement = nullptr);

/// A torus around the y axis with `bands` ≥ 3 rows around the tube and `sectors` ≥ 3 columns around the axis. The center line of
/// the tube is at distance `radius` from the axis; tube < radius. With R = radius and t = tube:
///
///   P(u, v) = ((R − t cos 2πv) cos 2πu, t sin 2πv, −(R − t cos 2πv) sin 2πu)
///
/// v = 0 is the innermost circle, 1/4 the uppermost, 1/2 the outermost. A displacement field must use MapEdges::torus.
Mesh torus(float radius, float tube, int bands, int sectors, const Displacement* displacement = nullptr);

/// A tube along a trefoil knot on a torus around the y axis, with `bands` ≥ 3 rows around the tube and `sectors` ≥ 3 columns along
/// the knot. The knot winds around the axis twice, at a mean distance of `radius`. It does not intersect itself if tube < radius /
/// 4. The formula is in torus_knot.cpp. A displacement field must use MapEdges::torus.
Mesh torus_knot(float radius, float tube, int bands, int sectors, const Displacement* displacement = nullptr);

/// A square in the plane y = 0 with corners at ±size/2, facing up, divided into segments² squares. u grows along +x, v along +z.
/// A displacement field must use MapEdges::sheet.
Mesh plane(float size, int segments = 1, const Displacement* displacement = nullptr);

/// An axis-aligned cube around the origin with edges of length `size`. Each face is divided into segments² squares, and its texture
/// coordinates cover [0, 1]². A displacement field must use MapEdges::sheet. Heights fade to zero towards the
/// edges of each face, over a fraction kFadeWidth of its width.
Mesh cube(float size, int segments = 1, const Displacement* displacement = nullptr);

/// Points of plane(), torus() and torus_knot() at any (u, v) in [0, 1]², for surfaces that are tessellated in another way (PointSurface).
/// On the tori, opposite edges of the square have the same positions, bit for bit.
MeshPoint plane_point(double size, double u, double v);
MeshPoint torus_point(double radius, double tube, double u, double v);
MeshPoint torus_knot_point(double radius, double tube, double u, double v);

}  // namespace halfspace::HS_LANES
