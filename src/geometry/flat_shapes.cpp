// SPDX-License-Identifier: Apache-2.0
//
// Plane and cube, which consist of square faces.
#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

// Center and axes of a face seen from the front. `up` points towards the first row of the map.
struct Face {
  glm::dvec3 center, right, up;
};

// Fades to zero towards x = 0 and x = 1.
FadeStep fade_from_edges(double x) {
  const FadeStep f = fade_in(std::min(x, 1.0 - x));
  return {f.value, x < 0.5 ? f.slope : -f.slope};
}

Fade fade_of_face(double u, double v) {
  const FadeStep across = fade_from_edges(u), down = fade_from_edges(v);
  return {across.value * down.value, across.slope * down.value, across.value * down.slope};
}

// Adds a face with half edge length h, centered at h·center. Coordinates are computed as ratios of integers, which are exactly
// antisymmetric about the middle. The vertices of adjacent faces therefore match bit for bit.
void add_face(SurfaceMesh& mesh, double h, const Face& face, int segments, bool fades) {
  int first = -1;
  const auto coordinate = [&](int i) { return static_cast<double>(2 * i - segments) / segments; };
  for (int i = 0; i <= segments; ++i) {
    for (int j = 0; j <= segments; ++j) {
      MeshPoint p{};
      p.uv = {static_cast<double>(j) / segments, static_cast<double>(i) / segments};
      p.position = h * (face.center + face.right * coordinate(j) - face.up * coordinate(i));
      p.du = 2.0 * h * face.right;
      p.dv = -2.0 * h * face.up;
      p.normal = glm::cross(face.right, face.up);
      if (fades) p.fade = fade_of_face(p.uv.x, p.uv.y);
      const int index = mesh.add(p);
      if (first < 0) first = index;
    }
  }
  mesh.add_grid(first, segments, segments);
}

}  // namespace

MeshPoint plane_point(double size, double u, double v) {
  MeshPoint p{};
  p.uv = {u, v};
  p.position = {size * (u - 0.5), 0.0, size * (v - 0.5)};
  p.du = {size, 0.0, 0.0};
  p.dv = {0.0, 0.0, size};
  p.normal = {0.0, 1.0, 0.0};
  return p;
}

Mesh plane(float size, int segments, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(size, >, 0.0f, "plane or cube: the size is not positive; expected more than 0");
  HS_CHECK_OP(segments, >=, 1, "plane or cube: the number of segments is not positive; expected at least 1");
  SurfaceMesh mesh(displacement);
  add_face(mesh, 0.5 * static_cast<double>(size), {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, segments, false);
  return mesh.take();
}

Mesh cube(float size, int segments, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(size, >, 0.0f, "plane or cube: the size is not positive; expected more than 0");
  HS_CHECK_OP(segments, >=, 1, "plane or cube: the number of segments is not positive; expected at least 1");
  SurfaceMesh mesh(displacement);
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const Face& face : {Face{x, -z, y}, Face{-x, z, y}, Face{y, x, -z}, Face{-y, x, z}, Face{z, x, y}, Face{-z, -x, y}}) {
    add_face(mesh, 0.5 * static_cast<double>(size), face, segments, true);
  }
  return mesh.take();
}

}  // namespace halfspace::HS_LANES
