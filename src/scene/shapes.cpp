// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

#include "core/check.h"
#include "core/trig_double.h"

namespace halfspace {

namespace {

// A point of the unit sphere at latitude v, longitude u, with its texture coordinates and the direction of east.
void add_sphere_vertex(Mesh& mesh, double radius, const SinCosDouble& v_angle, const SinCosDouble& u_angle, glm::dvec2 uv) {
  // + 0.0: no negative zeros, so that equal points have equal bits.
  const glm::dvec3 n(v_angle.sin * u_angle.cos + 0.0, v_angle.cos + 0.0, -v_angle.sin * u_angle.sin + 0.0);
  mesh.positions.emplace_back(radius * n);
  mesh.normals.emplace_back(n);
  mesh.tangents.emplace_back(static_cast<float>(-u_angle.sin + 0.0), 0.0f, static_cast<float>(-u_angle.cos + 0.0), 1.0f);
  mesh.uvs.emplace_back(uv);
}

// Row i of the sphere's vertices: one per sector at a pole, one more than sectors elsewhere.
void add_sphere_row(Mesh& mesh, int i, int latitudes, int longitudes, double radius) {
  const double v = static_cast<double>(i) / latitudes;
  const SinCosDouble v_angle = sincos_turns(0.5 * v);
  if (i == 0 || i == latitudes) {
    for (int j = 0; j < longitudes; ++j) {
      const double u = (j + 0.5) / longitudes;
      add_sphere_vertex(mesh, radius, v_angle, sincos_turns(u), {u, v});
    }
    return;
  }
  for (int j = 0; j <= longitudes; ++j) {
    const double u = static_cast<double>(j) / longitudes;
    add_sphere_vertex(mesh, radius, v_angle, sincos_turns(u), {u, v});
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

Mesh uv_sphere(int latitudes, int longitudes, float radius) {
  HS_CHECK_OP(latitudes, >=, 2);
  HS_CHECK_OP(longitudes, >=, 3);
  HS_CHECK_OP(radius, >, 0.0f);
  Mesh mesh;
  std::vector<int> row_start;
  for (int i = 0; i <= latitudes; ++i) {
    row_start.push_back(static_cast<int>(mesh.positions.size()));
    add_sphere_row(mesh, i, latitudes, longitudes, static_cast<double>(radius));
  }
  for (int i = 0; i < latitudes; ++i) {
    const int north = row_start[static_cast<std::size_t>(i)];
    const int south = row_start[static_cast<std::size_t>(i) + 1];
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
