// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/geometry/double_vectors.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

using Triangle = std::array<int, 3>;

// Directions from the origin, not normalized, and the triangles between them. Corner 0 is the north pole and corner 1 the south pole.
struct Polyhedron {
  std::vector<glm::dvec3> corners;
  std::vector<Triangle> triangles;
};

// In addition to the poles there are five corners at each of the latitudes ±atan(1/2). The northern ones are at multiples of a
// fifth of a turn, the southern ones halfway between them.
Polyhedron icosahedron() {
  Polyhedron p{{{0, 1, 0}, {0, -1, 0}}, {}};
  for (int k = 0; k < 10; ++k) {
    const SinCosDouble a = sincos_turns(0.1 * k);
    p.corners.emplace_back(2.0 * a.cos, k % 2 == 0 ? 1.0 : -1.0, -2.0 * a.sin);
  }
  for (int k = 0; k < 10; k += 2) {
    const int north = 2 + k, south = 3 + k, next_north = 2 + (k + 2) % 10, next_south = 2 + (k + 3) % 10;
    p.triangles.push_back({0, north, next_north});
    p.triangles.push_back({north, south, next_north});
    p.triangles.push_back({next_north, south, next_south});
    p.triangles.push_back({1, next_south, south});
  }
  return p;
}

// Splits each triangle into four. The two triangles at an edge share its new corner.
Polyhedron divided(const Polyhedron& from) {
  Polyhedron p{from.corners, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(p.corners.size()));
    if (is_new) p.corners.push_back(unit(p.corners[static_cast<std::size_t>(a)]) + unit(p.corners[static_cast<std::size_t>(b)]));
    return entry->second;
  };
  for (const auto& [a, b, c] : from.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    p.triangles.insert(p.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return p;
}

// Returns the texture coordinates of a direction. Vertex positions are computed from these coordinates, so both agree exactly. u is
// a multiple of 2^-32, which makes u + 1 exact.
glm::dvec2 map_coordinates(const glm::dvec3& p) {
  const float x = static_cast<float>(p.x), z = static_cast<float>(p.z), y = static_cast<float>(p.y);
  const double turns = static_cast<double>(halfspace::atan2(-z, x)) / (2.0 * std::numbers::pi);
  const double v = static_cast<double>(halfspace::atan2(static_cast<float>(std::sqrt(p.x * p.x + p.z * p.z)), y)) / std::numbers::pi;
  return {std::floor((turns - std::floor(turns)) * 0x1p32) * 0x1p-32, v};
}

MeshPoint sphere_point(double radius, const glm::dvec2& uv, double u_in_first_turn) {
  const SinCosDouble pi_v = sincos_turns(0.5 * uv.y);
  const SphereFrame frame = sphere_frame(sincos_turns(u_in_first_turn), pi_v);
  MeshPoint p{};
  p.uv = uv;
  p.position = radius * frame.normal;
  p.normal = frame.normal;
  p.normal_du = (2.0 * std::numbers::pi * pi_v.sin) * frame.east;
  p.normal_dv = -std::numbers::pi * frame.north;
  p.du = radius * p.normal_du;
  p.dv = radius * p.normal_dv;
  p.tangent = frame.east;
  return p;
}

class Icosphere {
 public:
  Icosphere(int level, double radius, const Displacement* displacement) : radius_(radius), mesh_(displacement) {
    shape_ = icosahedron();
    for (int i = 0; i < level; ++i) shape_ = divided(shape_);
    for (const glm::dvec3& p : shape_.corners) uvs_.push_back(map_coordinates(p));
    uvs_[0].y = 0.0;
    uvs_[1].y = 1.0;
  }

  Mesh make() {
    for (const Triangle& t : shape_.triangles) collect_pole(t);
    const double north = mean_height(0), south = mean_height(1);
    for (const Triangle& t : shape_.triangles) add(t, north, south);
    return mesh_.take();
  }

 private:
  static bool is_pole(int corner) { return corner < 2; }
  double u_of(int corner) const { return uvs_[static_cast<std::size_t>(corner)].x; }

  // Returns u at the corners of a triangle, continued beyond 1 across the seam. At a pole, u is the mean of the other two corners.
  std::array<double, 3> us_of(const Triangle& t) const {
    std::array<double, 3> u{};
    double low = 1.0, high = 0.0;
    for (const int corner : t) {
      if (is_pole(corner)) continue;
      low = std::min(low, u_of(corner));
      high = std::max(high, u_of(corner));
    }
    const bool over_seam = high - low > 0.5;
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_pole(t[k])) continue;
      u[k] = u_of(t[k]) + (over_seam && u_of(t[k]) < 0.5 ? 1.0 : 0.0);
      sum += u[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_pole(t[k])) u[k] = 0.5 * sum;
    }
    return u;
  }

  void collect_pole(const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_pole(t[k])) pole_us_[static_cast<std::size_t>(t[k])].push_back(us_of(t)[k]);
    }
  }

  MeshPoint pole_point(int pole, double u) const { return sphere_point(radius_, {u, uvs_[static_cast<std::size_t>(pole)].y}, u); }

  double mean_height(int pole) const {
    const std::vector<double>& us = pole_us_[static_cast<std::size_t>(pole)];
    double sum = 0.0;
    for (const double u : us) sum += mesh_.height_at(pole_point(pole, u));
    return sum / static_cast<double>(us.size());
  }

  void add(const Triangle& t, double north, double south) {
    const std::array<double, 3> u = us_of(t);
    std::array<int, 3> vertices{};
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[k] = is_pole(t[k]) ? mesh_.add_pole(pole_point(t[k], u[k]), t[k] == 0 ? north : south) : vertex(t[k], u[k]);
    }
    mesh_.add_triangle(vertices[0], vertices[1], vertices[2]);
  }

  // Returns the vertex of a corner. A corner on the seam has two: one at u and one at u + 1.
  int vertex(int corner, double u) {
    const glm::dvec2& uv = uvs_[static_cast<std::size_t>(corner)];
    const auto [entry, is_new] = vertices_.try_emplace({corner, u != uv.x}, 0);
    if (is_new) entry->second = mesh_.add(sphere_point(radius_, {u, uv.y}, uv.x));
    return entry->second;
  }

  double radius_;
  SurfaceMesh mesh_;
  Polyhedron shape_;
  std::vector<glm::dvec2> uvs_;  // texture coordinates of the corners, u in [0, 1)
  std::array<std::vector<double>, 2> pole_us_;
  std::map<std::pair<int, bool>, int> vertices_;
};

}  // namespace

Mesh icosphere(int level, float radius, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(level, >=, 0, "icosphere: the level is negative; expected at least 0");
  HS_CHECK_OP(radius, >, 0.0f, "icosphere: the radius is not positive; expected more than 0");
  return Icosphere(level, static_cast<double>(radius), displacement).make();
}

}  // namespace halfspace::HS_LANES
