// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

#include "core/check.h"

namespace halfspace {

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

// A square face with half edge h round h·center; right and up are unit vectors as seen from the front, where the
// first texture row is at the top.
void add_face(Mesh& mesh, float h, const glm::vec3& center, const glm::vec3& right, const glm::vec3& up) {
  const int first = static_cast<int>(mesh.positions.size());
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0)}) {
    mesh.positions.push_back(h * (center + right * (2.0f * uv.x - 1.0f) + up * (1.0f - 2.0f * uv.y)));
    mesh.normals.push_back(glm::cross(right, up));
    mesh.tangents.emplace_back(right, 1.0f);
    mesh.uvs.push_back(uv);
  }
  add_triangle(mesh, first, first + 1, first + 2);
  add_triangle(mesh, first, first + 2, first + 3);
}

}  // namespace

// One vertex per sector at a pole, one more than sectors elsewhere.
SphereRow uv_sphere_row(int i, int latitudes, int longitudes) {
  const bool is_pole = i == 0 || i == latitudes;
  const int first = i == 0 ? 0 : longitudes + (i - 1) * (longitudes + 1);
  return {first, is_pole ? longitudes : longitudes + 1, longitudes, static_cast<double>(i) / latitudes, is_pole};
}

// + 0.0: no negative zeros, so that equal points have equal bits.
SphereFrame sphere_frame(const SinCosDouble& two_pi_u, const SinCosDouble& pi_v) {
  return {glm::dvec3(-two_pi_u.sin + 0.0, 0.0, -two_pi_u.cos + 0.0),
          glm::dvec3(-pi_v.cos * two_pi_u.cos + 0.0, pi_v.sin, pi_v.cos * two_pi_u.sin + 0.0),
          glm::dvec3(pi_v.sin * two_pi_u.cos + 0.0, pi_v.cos + 0.0, -pi_v.sin * two_pi_u.sin + 0.0)};
}

Mesh uv_sphere(int latitudes, int longitudes, float radius) {
  HS_CHECK_OP(latitudes, >=, 2);
  HS_CHECK_OP(longitudes, >=, 3);
  HS_CHECK_OP(radius, >, 0.0f);
  Mesh mesh;
  for (int i = 0; i <= latitudes; ++i) add_sphere_row(mesh, uv_sphere_row(i, latitudes, longitudes), static_cast<double>(radius));
  for (int i = 0; i < latitudes; ++i) {
    const int north = uv_sphere_row(i, latitudes, longitudes).first;
    const int south = uv_sphere_row(i + 1, latitudes, longitudes).first;
    for (int j = 0; j < longitudes; ++j) {
      // Seen from outside: north-west north+j, north-east north+j+1, and the same in the south. At a pole there is
      // only vertex j.
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

Mesh plane(float size) {
  HS_CHECK_OP(size, >, 0.0f);
  Mesh mesh;
  add_face(mesh, 0.5f * size, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  return mesh;
}

Mesh cube(float size) {
  HS_CHECK_OP(size, >, 0.0f);
  Mesh mesh;
  const float h = 0.5f * size;
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  add_face(mesh, h, x, -z, y);
  add_face(mesh, h, -x, z, y);
  add_face(mesh, h, y, x, -z);
  add_face(mesh, h, -y, x, z);
  add_face(mesh, h, z, x, y);
  add_face(mesh, h, -z, -x, y);
  return mesh;
}

}  // namespace halfspace
