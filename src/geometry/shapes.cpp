// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/shapes.h"

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

namespace {

void add_sphere_row(Mesh& mesh, const SphereRow& row, double radius) {
  const SinCosDouble pi_v = sincos_turns(0.5 * row.v);
  for (int j = 0; j < row.count; ++j) {
    const SphereFrame frame = sphere_frame(sincos_turns(row.u(j)), pi_v);
    mesh.positions.emplace_back(radius * frame.normal);
    mesh.normals.emplace_back(frame.normal);
    mesh.tangents.emplace_back(glm::vec3(frame.east), 1.0f);
    mesh.uvs.emplace_back(row.u(j), row.v);
  }
}

void add_triangle(Mesh& mesh, int a, int b, int c) {
  for (const int i : {a, b, c}) mesh.indices.push_back(static_cast<uint32_t>(i));
}

}  // namespace

// A pole has one vertex per sector, every other row one more.
SphereRow uv_sphere_row(int i, int latitudes, int longitudes) {
  const bool is_pole = i == 0 || i == latitudes;
  const int first = i == 0 ? 0 : longitudes + (i - 1) * (longitudes + 1);
  return {first, is_pole ? longitudes : longitudes + 1, longitudes, static_cast<double>(i) / latitudes, is_pole};
}

// Adding 0.0 turns negative zeros into positive ones, so that equal points have equal bits.
SphereFrame sphere_frame(const SinCosDouble& two_pi_u, const SinCosDouble& pi_v) {
  return {glm::dvec3(-two_pi_u.sin + 0.0, 0.0, -two_pi_u.cos + 0.0),
          glm::dvec3(-pi_v.cos * two_pi_u.cos + 0.0, pi_v.sin, pi_v.cos * two_pi_u.sin + 0.0),
          glm::dvec3(pi_v.sin * two_pi_u.cos + 0.0, pi_v.cos + 0.0, -pi_v.sin * two_pi_u.sin + 0.0)};
}

Mesh uv_sphere(int latitudes, int longitudes, float radius) {
  const FloatMode float_mode;
  HS_CHECK_OP(latitudes, >=, 2, "uv_sphere: too few latitudes; expected at least 2");
  HS_CHECK_OP(longitudes, >=, 3, "uv_sphere: too few longitudes; expected at least 3");
  HS_CHECK_OP(radius, >, 0.0f, "uv_sphere: the radius is not positive; expected more than 0");
  Mesh mesh;
  for (int i = 0; i <= latitudes; ++i) add_sphere_row(mesh, uv_sphere_row(i, latitudes, longitudes), static_cast<double>(radius));
  for (int i = 0; i < latitudes; ++i) {
    const int north = uv_sphere_row(i, latitudes, longitudes).first;
    const int south = uv_sphere_row(i + 1, latitudes, longitudes).first;
    for (int j = 0; j < longitudes; ++j) {
      // Seen from outside, the north-west corner is north + j, the north-east corner is north + j + 1, and likewise in the south.
      // At a pole there is only vertex j.
      if (i == 0) {
        add_triangle(mesh, north + j, south + j, south + j + 1);
      } else if (i == latitudes - 1) {
        add_triangle(mesh, north + j, south + j, north + j + 1);
      } else {
        add_triangle(mesh, north + j, south + j, south + j + 1);
        add_triangle(mesh, north + j, south + j + 1, north + j + 1);
      }
    }
  }
  return mesh;
}

}  // namespace halfspace::HS_LANES
