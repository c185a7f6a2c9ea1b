// SPDX-License-Identifier: Apache-2.0
//
// Shadows from the moments of a filtered depth distribution. The map stores the means of d, d², d³ and d⁴ over a neighborhood,
// where d is the linear depth from 0 (near) to 1 (far). They give an upper bound on the light that reaches a given depth.
#pragma once

#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace::HS_LANES {

/// Returns the linear depth: 0 at the near plane of the view, 1 at its far plane, proportional to the distance along the axis.
template <class R>
HS_INLINE R linear_depth(const ShadowView& view, R depth, R w) {
  if (!view.perspective) return R(1) - depth;
  return (w - R(view.near)) * R(1.0f / (view.far - view.near));
}

/// Returns the bilinearly interpolated moments at a point.
template <class R>
HS_INLINE vec4<R> moments_at(const ShadowView& view, const ShadowCoordinates<R>& p) {
  const R x = p.x - R(0.5f), y = p.y - R(0.5f);
  const R left = floor(x), low = floor(y);
  const R fx = x - left, fy = y - low;
  const IntOf<R> i = truncate_to_int(left), j = truncate_to_int(low), last(view.size - 1);
  const auto texel = [&](IntOf<R> column, IntOf<R> row) {
    column = min(max(column, IntOf<R>(0)), last);
    row = last - min(max(row, IntOf<R>(0)), last);
    const auto m = gather_row<4>(&view.moments->x, IntOf<R>((row * IntOf<R>(view.size) + column) * IntOf<R>(4)));
    return vec4<R>(R(m[0]), R(m[1]), R(m[2]), R(m[3]));
  };
  const IntOf<R> i1 = i + IntOf<R>(1), j1 = j + IntOf<R>(1);
  const vec4<R> lower = texel(i, j) * (R(1) - fx) + texel(i1, j) * fx;
  const vec4<R> upper = texel(i, j1) * (R(1) - fx) + texel(i1, j1) * fx;
  return lower * (R(1) - fy) + upper * fy;
}

/// Returns the upper bound on the light given by mean and variance (Chebyshev's inequality). Light leaks where occluders at two
/// different depths overlap.
template <class R>
HS_INLINE R chebyshev_shadow(const ShadowView& view, const ShadowCoordinates<R>& p) {
  const vec4<R> m = moments_at(view, p);
  const R depth = linear_depth(view, p.depth, p.w);
  const R variance = max(m.y - m.x * m.x, R(1e-7f));
  const R beyond = depth - m.x;
  return select(beyond <= R(0), R(1), variance / (variance + beyond * beyond));
}

/// Returns the upper bound on the light given by four moments. It is attained by the distribution with these moments that is
/// concentrated at the depth of the receiver and two other depths. C. Peters and R. Klein, "Moment shadow mapping", I3D 2015,
/// section 3 (Hamburger, four moments).
template <class R>
HS_INLINE R four_moment_shadow(const ShadowView& view, const ShadowCoordinates<R>& p) {
  // Biases the moments slightly towards the moments of a spread-out distribution, to compensate for rounding errors.
  constexpr float kSpread = 1e-5f;
  const vec4<R> m = moments_at(view, p) * (1.0f - kSpread) + vec4<R>(R(0.5f * kSpread));
  const R z0 = linear_depth(view, p.depth, p.w);
  // Cholesky factorization of the Hankel matrix (1 b1 b2; b1 b2 b3; b2 b3 b4), solved for (1, z0, z0²).
  const R l32_d22 = fma(-m.x, m.y, m.z);
  const R d22 = fma(-m.x, m.x, m.y);
  const R variance_of_square = fma(-m.y, m.y, m.w);
  const R d33_d22 = max(fma(variance_of_square, d22, -l32_d22 * l32_d22), R(1e-30f));
  const R inverse_d22 = R(1) / max(d22, R(1e-20f));
  const R l32 = l32_d22 * inverse_d22;
  R c1 = (z0 - m.x) * inverse_d22;
  R c2 = (z0 * z0 - m.y - l32 * (z0 - m.x)) * d22 / d33_d22;
  c1 -= l32 * c2;
  const R c0 = R(1) - m.x * c1 - m.y * c2;
  // The other two depths are the roots of c0 + c1·z + c2·z².
  const R inverse_c2 = R(1) / select(c2 == R(0), R(1e-20f), c2);
  const R half = R(-0.5f) * c1 * inverse_c2;
  const R root = sqrt(max(half * half - c0 * inverse_c2, R(0)));
  const R z1 = half - root, z2 = half + root;
  // The fraction of the distribution in front of z0: 0 if z0 ≤ z1, the weight at z1 if z1 < z0 ≤ z2, and otherwise 1 − the weight at z0.
  const R at_z1 = (z0 * z2 - m.x * (z0 + z2) + m.y) / ((z2 - z1) * (z0 - z1));
  const R at_z0 = (z1 * z2 - m.x * (z1 + z2) + m.y) / ((z0 - z1) * (z0 - z2));
  const R shadow = select(z0 <= z1, R(0), select(z0 <= z2, at_z1, R(1) - at_z0));
  return clamp(R(1) - shadow, R(0), R(1));
}

}  // namespace halfspace::HS_LANES
