// SPDX-License-Identifier: Apache-2.0
//
// What the invented planets and materials share: gradient noise (after Perlin, "Improving noise", 2002, with a hash in place of his
// table), summed over octaves in three dimensions and looked up on the unit sphere. Lanes run along a row; only
// correctly rounded operations are used, so all has the same bits at every lane width.
#pragma once

#include <vector>

#include "halfspace/core/vec.h"

namespace halfspace::procedural {

using Vec = vec3<Real>;

/// Gradient noise in about [−1, 1], zero at the integers; |p| must stay below 2^20.
Real noise(const Vec& p, int32_t seed);

/// Octaves of noise, each twice as fine and half as strong as the one before.
Real cloud(Vec p, int octaves, int32_t seed);

/// The same with sharp crests where the noise is zero: mountain chains, in [0, 2).
Real ridges(Vec p, int octaves, int32_t seed);

/// Gradient noise in the plane that repeats after period_x along x and period_y along y; about [−1, 1], zero at the integers.
/// |x|, |y| must stay below 2^20, periods ≥ 1.
Real tiled_noise(Real x, Real y, int period_x, int period_y, int32_t seed);

/// Octaves of tiled_noise, each twice as fine and half as strong as the one before, for as long as a wave spans at least two
/// of `texels` a period: at (u, v) · period, periodic in u and v with 1. `octaves` at most.
Real tiled_cloud(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed);

/// The same with sharp crests where the noise is zero, in [0, 2).
Real tiled_ridges(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed);

HS_INLINE Real lerp(Real a, Real b, Real t) { return fma(t, b - a, a); }

/// 0 below lo, 1 above hi, smooth between.
HS_INLINE Real step(float lo, float hi, Real x) {
  const Real t = clamp((x - Real(lo)) * Real(1.0f / (hi - lo)), Real(0.0f), Real(1.0f));
  return t * t * (Real(3.0f) - Real(2.0f) * t);
}

/// p · s + (x, y, z): another scale and another part of the noise.
HS_INLINE Vec scaled(const Vec& p, float s, float x, float y, float z) {
  return Vec(fma(p.x, Real(s), Real(x)), fma(p.y, Real(s), Real(y)), fma(p.z, Real(s), Real(z)));
}

/// The directions of a row's pixel centres in the plane of the equator, padded to whole packets.
struct Longitudes {
  std::vector<float> cos, minus_sin;
};

Longitudes longitudes_of(int width);

}  // namespace halfspace::procedural
