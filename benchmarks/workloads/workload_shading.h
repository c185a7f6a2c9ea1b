// SPDX-License-Identifier: Apache-2.0
//
// The lighting formulas of the workloads.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace {

/// Normalizes v, which must not be zero.
template <class R>
HS_INLINE vec3<R> unit(const vec3<R>& v) {
  return v * inverse_sqrt(dot(v, v));
}

/// The lit color is `diffuse` times the surface color, plus `specular`.
template <class R>
struct WorkloadLight {
  R diffuse, specular;
};

/// Blinn-Phong: 0.08 + 0.8·max(N·L, 0) and 0.4·max(N·H, 0)^48. l and v must be unit vectors; normal can have any length.
template <class R>
HS_INLINE WorkloadLight<R> blinn_phong(const vec3<R>& normal, const vec3<R>& l, const vec3<R>& v) {
  const vec3<R> n = unit(normal), h = unit(l + v);
  return {R(0.08f) + R(0.8f) * max(dot(n, l), R(0)), R(0.4f) * unit_pow(max(dot(n, h), R(0)), R(48))};
}

/// Phong: 0.1 + 0.7·max(N·L, 0) and 0.3·max(R·V, 0)^32, where R is the reflected light direction. All arguments must be unit vectors.
template <class R>
HS_INLINE WorkloadLight<R> phong(const vec3<R>& n, const vec3<R>& l, const vec3<R>& v) {
  const R n_l = dot(n, l);
  const vec3<R> r = n * (R(2) * n_l) - l;
  return {R(0.1f) + R(0.7f) * max(n_l, R(0)), R(0.3f) * unit_pow(max(dot(r, v), R(0)), R(32))};
}

/// Returns the color of a lit surface, with alpha 1.
template <class R>
HS_INLINE vec4<R> lit(const vec3<R>& base, const WorkloadLight<R>& light) {
  return vec4<R>(base * light.diffuse + vec3<R>(light.specular), R(1));
}

}  // namespace halfspace
