// SPDX-License-Identifier: Apache-2.0
//
// A tube along a trefoil knot. The curve winds twice around the y axis and three times around the tube of a torus:
//
//   C(u) = (R + r cos φ) e(θ) + r sin φ k,   θ = 4πu, φ = 6πu, e(θ) = (cos θ, 0, −sin θ), k = up
//
// The curve is on the torus, so the normal of the torus, n = cos φ e + sin φ k, is perpendicular to the curve. Together with b = T
// × n it forms a frame that closes after one turn. The radial normal of the tube is perpendicular to both derivatives of the tube's
// surface regardless of how the frame twists.
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

constexpr double kThetaRate = 4.0 * std::numbers::pi, kPhiRate = 6.0 * std::numbers::pi;
constexpr double kRingShare = 0.4;  // r / R

// A point of the curve and its frame, with derivatives with respect to u.
struct Along {
  glm::dvec3 point, tangent_length;  // C, C'
  glm::dvec3 n, b, n_du, b_du;
};

Along along(double radius, double u) {
  const auto turns = [&](double times) { return sincos_turns(times * u - static_cast<int>(times * u)); };
  const SinCosDouble theta = turns(2.0), phi = turns(3.0);
  const double r = kRingShare * radius, ring = radius + r * phi.cos;
  const glm::dvec3 e(theta.cos, 0, -theta.sin), e1(-theta.sin, 0, -theta.cos), k(0, 1, 0);
  Along a;
  a.point = ring * e + r * phi.sin * k;
  a.tangent_length = (-r * kPhiRate * phi.sin) * e + (ring * kThetaRate) * e1 + (r * kPhiRate * phi.cos) * k;
  const glm::dvec3 second = (-r * kPhiRate * kPhiRate * phi.cos - ring * kThetaRate * kThetaRate) * e -
                            (2.0 * r * kPhiRate * kThetaRate * phi.sin) * e1 - (r * kPhiRate * kPhiRate * phi.sin) * k;
  const double length = glm::length(a.tangent_length);
  const glm::dvec3 t = a.tangent_length / length, t_du = (second - t * glm::dot(t, second)) / length;
  a.n = phi.cos * e + phi.sin * k;
  a.n_du = (-kPhiRate * phi.sin) * e + (phi.cos * kThetaRate) * e1 + (kPhiRate * phi.cos) * k;
  a.b = glm::cross(t, a.n);
  a.b_du = glm::cross(t_du, a.n) + glm::cross(t, a.n_du);
  return a;
}

// The point at the angle of b around the tube.
MeshPoint around(const Along& a, double tube, const SinCosDouble& b, const glm::dvec2& uv) {
  constexpr double turn = 2.0 * std::numbers::pi;
  MeshPoint p{};
  p.uv = uv;
  p.normal = b.cos * a.n + b.sin * a.b;
  p.normal_du = b.cos * a.n_du + b.sin * a.b_du;
  p.normal_dv = turn * (b.cos * a.b - b.sin * a.n);
  p.position = a.point + tube * p.normal;
  p.du = a.tangent_length + tube * p.normal_du;
  p.dv = tube * p.normal_dv;
  return p;
}

}  // namespace

MeshPoint torus_knot_point(double radius, double tube, double u, double v) {
  return around(along(radius, u == 1.0 ? 0.0 : u), tube, sincos_turns(v == 1.0 ? 0.0 : v), {u, v});
}

Mesh torus_knot(float radius, float tube, int bands, int sectors, const Displacement* displacement) {
  const FloatMode float_mode;
  HS_CHECK_OP(tube, >, 0.0f, "torus_knot: the radius of the tube is not positive; expected more than 0");
  HS_CHECK_OP(radius, >, tube, "torus_knot: the tube closes the hole; expected a radius larger than that of the tube");
  HS_CHECK_OP(bands, >=, 3, "torus_knot: too few bands; expected at least 3");
  HS_CHECK_OP(sectors, >=, 3, "torus_knot: too few sectors; expected at least 3");
  const double t = static_cast<double>(tube);
  std::vector<Along> curve;
  for (int j = 0; j <= sectors; ++j) curve.push_back(along(static_cast<double>(radius), static_cast<double>(j % sectors) / sectors));
  SurfaceMesh mesh(displacement);
  for (int i = 0; i <= bands; ++i) {
    const SinCosDouble b = sincos_turns(static_cast<double>(i % bands) / bands);
    for (int j = 0; j <= sectors; ++j) {
      const glm::dvec2 uv(static_cast<double>(j) / sectors, static_cast<double>(i) / bands);
      mesh.add(around(curve[static_cast<std::size_t>(j)], t, b, uv));
    }
  }
  mesh.add_grid(0, sectors, bands);
  return mesh.take();
}

}  // namespace halfspace::HS_LANES
