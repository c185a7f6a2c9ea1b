// SPDX-License-Identifier: Apache-2.0
//
// Mirrored light: the ray from the eye thrown back by a surface, with its derivatives on the screen, looked up in an
// environment (Igehy, "Tracing Ray Differentials", 1999, section 3.2: reflection).
//
// With d the vector from the eye to the surface and n the unit normal, r = d − 2 (d·n) n, and for a step of the screen
//   r' = d' − 2 ((d'·n + d·n') n + (d·n) n').
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/shading/environment.h"

namespace halfspace {

/// A value that varies over the screen, and its derivatives by a pixel to the right and up.
template <class R>
struct Differential {
  vec3<R> at, dx, dy;
};

/// The unit vector of v, which must not be 0: v/|v| changes by what of v' is across v, over |v|.
template <Number R>
HS_INLINE Differential<R> normalized(const Differential<R>& v) {
  const R inverse = inverse_sqrt(dot(v.at, v.at));
  const vec3<R> n = v.at * inverse;
  const auto across = [&](const vec3<R>& step) { return (step - n * dot(n, step)) * inverse; };
  return {n, across(v.dx), across(v.dy)};
}

/// d thrown back by a mirror with the unit normal n, on either side of it. Has the length of d.
template <Number R>
HS_INLINE Differential<R> reflected(const Differential<R>& d, const Differential<R>& n) {
  const R along = dot(d.at, n.at);
  const auto step = [&](const vec3<R>& dd, const vec3<R>& dn) {
    return dd - (n.at * (dot(dd, n.at) + dot(d.at, dn)) + dn * along) * R(2.0f);
  };
  return {d.at - n.at * (R(2.0f) * along), step(d.dx, n.dx), step(d.dy, n.dy)};
}

/// The light of the surroundings in a mirror: from_eye_ws is the vector from the eye to the surface (of any length), normal_ws
/// the unit normal, both with their derivatives.
template <Number R>
HS_INLINE vec3<R> environment_reflection(const EnvironmentBlend& environment, const Differential<R>& from_eye_ws,
                                         const Differential<R>& normal_ws) {
  const Differential<R> r = reflected(from_eye_ws, normal_ws);
  return environment.light(r.at, r.dx, r.dy);
}

}  // namespace halfspace
