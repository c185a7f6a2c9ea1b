// SPDX-License-Identifier: Apache-2.0
//
// Cylinder, cone and torus: surfaces of revolution around the y axis, with caps on the open ones.
#include <cmath>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// The outward direction at longitude 2πu, its derivative with respect to u, and the direction of that derivative.
struct Meridian {
  glm::dvec3 out, out_du, east;
};

Meridian meridian(double u) {
  const SinCosDouble a = sincos_turns(u);
  const glm::dvec3 east(-a.sin, 0, -a.cos);
  return {glm::dvec3(a.cos, 0, -a.sin), kTurn * east, east};
}

constexpr glm::dvec3 kUp(0, 1, 0);

// Fades to zero towards v = 0 and v = 1.
Fade fade_along_v(double v) {
  const FadeStep f = fade_in(v > 0.5 ? 1.0 - v : v);
  return {f.value, 0.0, v > 0.5 ? -f.slope : f.slope};
}

// Adds sectors + 1 vertices at equal steps from u = 0 to u = 1, and returns the index of the first.
template <class F>
int add_row(SurfaceMesh& mesh, int sectors, F point) {
  int first = -1;
  for (int j = 0; j <= sectors; ++j) {
    const int index = mesh.add(point(static_cast<double>(j) / sectors));
    if (j == 0) first = index;
  }
  return first;
}

// The disk at height y, facing up (up = 1) or down (up = −1): x = r·(2u − 1), z = up·r·(2v − 1), where r is the radius of the rim.
// Heights fade with the distance ρ from the center, as a fraction of the radius; ∂ρ/∂u = 2(2u − 1)/ρ, and likewise for v.
class Cap {
 public:
  Cap(double radius, double y, double up) : radius_(radius), y_(y), up_(up) {}

  MeshPoint at(double rho, const Meridian& m) const {
    MeshPoint p{};
    const double x = rho * m.out.x, z = up_ * rho * m.out.z;  // 2u − 1, 2v − 1
    p.uv = {0.5 + 0.5 * x, 0.5 + 0.5 * z};
    p.position = (rho * radius_) * m.out + y_ * kUp;
    p.du = {2.0 * radius_, 0, 0};
    p.dv = {0, 0, up_ * 2.0 * radius_};
    p.normal = up_ * kUp;
    const FadeStep f = fade_in(1.0 - rho);
    p.fade = {f.value, f.slope == 0.0 ? 0.0 : -f.slope * 2.0 * x / rho, f.slope == 0.0 ? 0.0 : -f.slope * 2.0 * z / rho};
    return p;
  }

 private:
  double radius_, y_, up_;
};

void add_cap(SurfaceMesh& mesh, double radius, double y, bool faces_up, int rings, int sectors) {
  const Cap cap(radius, y, faces_up ? 1.0 : -1.0);
  const int center = mesh.add(cap.at(0.0, meridian(0.0)));
  for (int i = 1; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) mesh.add(cap.at(static_cast<double>(i) / rings, meridian(static_cast<double>(j) / sectors)));
  }
  const auto triangle = [&](int a, int b, int c) { faces_up ? mesh.add_triangle(a, b, c) : mesh.add_triangle(a, c, b); };
  const auto vertex = [&](int ring, int j) { return center + 1 + (ring - 1) * sectors + j % sectors; };
  for (int j = 0; j < sectors; ++j) triangle(center, vertex(1, j), vertex(1, j + 1));
  for (int i = 2; i <= rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      triangle(vertex(i - 1, j), vertex(i, j), vertex(i, j + 1));
      triangle(vertex(i - 1, j), vertex(i, j + 1), vertex(i - 1, j + 1));
    }
  }
}

void check_counts(int bands, int sectors, int min_bands) {
  HS_CHECK_OP(bands, >=, min_bands, "round shape: too few bands; expected at least 1, or 3 for a torus");
  HS_CHECK_OP(sectors, >=, 3, "round shape: too few sectors; expected at least 3");
}

}  // namespace

Mesh cylinder(float radius, float length, int bands, int sectors, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(radius, >, 0.0f, "round shape: the radius is not positive; expected more than 0");
  HS_CHECK_OP(length, >, 0.0f, "round shape: the length is not positive; expected more than 0");
  check_counts(bands, sectors, 1);
  const double r = static_cast<double>(radius), l = static_cast<double>(length);
  SurfaceMesh mesh(displacement);
  for (int i = 0; i <= bands; ++i) {
    const double v = static_cast<double>(i) / bands;
    add_row(mesh, sectors, [&](double u) {
      const Meridian m = meridian(u);
      MeshPoint p{};
      p.uv = {u, v};
      p.position = r * m.out + (l * (0.5 - v)) * kUp;
      p.du = r * m.out_du;
      p.dv = -l * kUp;
      p.normal = m.out;
      p.normal_du = m.out_du;
      p.fade = fade_along_v(v);
      return p;
    });
  }
  mesh.add_grid(0, sectors, bands);
  add_cap(mesh, r, 0.5 * l, true, bands, sectors);
  add_cap(mesh, r, -0.5 * l, false, bands, sectors);
  return mesh.take();
}

Mesh cone(float radius, float length, int bands, int sectors, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(radius, >, 0.0f, "round shape: the radius is not positive; expected more than 0");
  HS_CHECK_OP(length, >, 0.0f, "round shape: the length is not positive; expected more than 0");
  check_counts(bands, sectors, 1);
  const double r = static_cast<double>(radius), l = static_cast<double>(length), slant = std::sqrt(r * r + l * l);
  const auto at = [&](double u, double v) {
    const Meridian m = meridian(u);
    MeshPoint p{};
    p.uv = {u, v};
    p.position = (v * r) * m.out + (l * (0.5 - v)) * kUp;
    p.du = (v * r) * m.out_du;
    p.dv = r * m.out - l * kUp;
    p.normal = (l * m.out + r * kUp) / slant;
    p.normal_du = (l / slant) * m.out_du;
    p.tangent = m.east;
    p.fade = fade_along_v(v);
    return p;
  };
  SurfaceMesh mesh(displacement);
  for (int j = 0; j < sectors; ++j) mesh.add_pole(at((j + 0.5) / sectors, 0.0), 0.0);
  for (int i = 1; i <= bands; ++i) add_row(mesh, sectors, [&](double u) { return at(u, static_cast<double>(i) / bands); });
  for (int j = 0; j < sectors; ++j) mesh.add_triangle(j, sectors + j, sectors + j + 1);
  mesh.add_grid(sectors, sectors, bands - 1);
  add_cap(mesh, r, -0.5 * l, false, bands, sectors);
  return mesh.take();
}

MeshPoint torus_point(double radius, double tube, double u, double v) {
  const Meridian m = meridian(u);
  const SinCosDouble b = sincos_turns(v);
  MeshPoint p{};
  p.uv = {u, v};
  p.normal = -b.cos * m.out + b.sin * kUp;
  p.normal_du = -b.cos * m.out_du;
  p.normal_dv = kTurn * (b.sin * m.out + b.cos * kUp);
  p.position = radius * m.out + tube * p.normal;
  p.du = radius * m.out_du + tube * p.normal_du;
  p.dv = tube * p.normal_dv;
  return p;
}

Mesh torus(float radius, float tube, int bands, int sectors, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(tube, >, 0.0f, "torus: the radius of the tube is not positive; expected more than 0");
  HS_CHECK_OP(radius, >, tube, "torus: the tube closes the hole; expected a radius larger than that of the tube");
  check_counts(bands, sectors, 3);
  const double r = static_cast<double>(radius), t = static_cast<double>(tube);
  SurfaceMesh mesh(displacement);
  for (int i = 0; i <= bands; ++i) add_row(mesh, sectors, [&](double u) { return torus_point(r, t, u, static_cast<double>(i) / bands); });
  mesh.add_grid(0, sectors, bands);
  return mesh.take();
}

}  // namespace halfspace::HS_LANES
