// SPDX-License-Identifier: Apache-2.0
//
// Environment reflection: the view ray is reflected at the surface together with its screen-space derivatives, and looked up in
// an environment (Igehy, "Tracing Ray Differentials", 1999, section 3.2).
//
// With d the vector from the eye to the surface and n the unit normal, r = d − 2 (d·n) n. For a step on the screen,
//   r' = d' − 2 ((d'·n + d·n') n + (d·n) n').
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/shading/environment/environment.h"

namespace halfspace::HS_LANES {

/// A vector and its derivatives for one pixel to the right and up.
template <class R>
struct Differential {
  vec3<R> at, dx, dy;
};

/// Normalizes v, which must not be 0. The derivative of v/|v| is the part of v' perpendicular to v, divided by |v|.
template <Number R>
HS_INLINE Differential<R> normalized(const Differential<R>& v) {
  const R inverse = inverse_sqrt(dot(v.at, v.at));
  const vec3<R> n = v.at * inverse;
  const auto across = [&](const vec3<R>& step) { return (step - n * dot(n, step)) * inverse; };
  return {n, across(v.dx), across(v.dy)};
}

/// Reflects d at a mirror with the unit normal n, which may be on either side. The length of d is preserved.
template <Number R>
HS_INLINE Differential<R> reflected(const Differential<R>& d, const Differential<R>& n) {
  const R along = dot(d.at, n.at);
  const auto step = [&](const vec3<R>& dd, const vec3<R>& dn) {
    return dd - (n.at * (dot(dd, n.at) + dot(d.at, dn)) + dn * along) * R(2.0f);
  };
  return {d.at - n.at * (R(2.0f) * along), step(d.dx, n.dx), step(d.dy, n.dy)};
}

/// Returns the light of the environment reflected at a surface. from_eye_ws is the vector from the eye to the surface, of any
/// length. normal_ws is the unit normal. Both include their derivatives.
template <Number R>
HS_INLINE vec3<R> environment_reflection(const EnvironmentBlend& environment, const Differential<R>& from_eye_ws,
                                         const Differential<R>& normal_ws) {
  const Differential<R> r = reflected(from_eye_ws, normal_ws);
  return environment.light(r.at, r.dx, r.dy);
}

}  // namespace halfspace::HS_LANES
