// SPDX-License-Identifier: Apache-2.0
//
// Gradient noise for the procedural planets and materials, after Perlin, "Improving noise", 2002, with a hash function instead of
// his permutation table. The planets sum octaves of 3D noise on the unit sphere. SIMD lanes run along a row. Only correctly rounded
// operations are used, so results are bit-identical for every SIMD width.
#pragma once

#include <vector>

#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES::procedural {

using Vec = vec3<Real>;

/// Gradient noise, roughly in [−1, 1] and zero at integer coordinates. |p| must stay below 2^20.
Real noise(const Vec& p, int32_t seed);

/// Sum of octaves of noise, each with twice the frequency and half the amplitude of the previous one.
Real cloud(Vec p, int octaves, int32_t seed);

/// Like cloud, with sharp crests where the noise is zero, as in mountain ranges. Values are in [0, 2).
Real ridges(Vec p, int octaves, int32_t seed);

/// Tileable 2D gradient noise with the periods period_x and period_y, roughly in [−1, 1] and zero at integer coordinates. |x| and |y| must
/// stay below 2^20; periods must be ≥ 1.
Real tiled_noise(Real x, Real y, int period_x, int period_y, int32_t seed);

/// Sum of up to `octaves` octaves of tiled_noise at (u, v) · period, each with twice the frequency and half the amplitude of the
/// previous one. It is periodic in u and v with period 1. `texels` is the number of texels across the map. Octaves whose lattice
/// cells are narrower than two texels are omitted.
Real tiled_cloud(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed);

/// Like tiled_cloud, with sharp crests where the noise is zero. Values are in [0, 2).
Real tiled_ridges(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed);

HS_INLINE Real lerp(Real a, Real b, Real t) { return fma(t, b - a, a); }

/// Smooth step: 0 below lo, 1 above hi. If lo > hi, the step falls from 1 to 0.
HS_INLINE Real step(float lo, float hi, Real x) {
  const Real t = clamp((x - Real(lo)) * Real(1.0f / (hi - lo)), Real(0.0f), Real(1.0f));
  return t * t * (Real(3.0f) - Real(2.0f) * t);
}

/// Returns p · s + (x, y, z). Selects the scale and the region of the noise that is used.
HS_INLINE Vec scaled(const Vec& p, float s, float x, float y, float z) {
  return Vec(fma(p.x, Real(s), Real(x)), fma(p.y, Real(s), Real(y)), fma(p.z, Real(s), Real(z)));
}

/// cos and −sin of the longitude at the pixel centers of a row, padded to a multiple of the SIMD width.
struct Longitudes {
  std::vector<float> cos, minus_sin;
};

Longitudes longitudes_of(int width);

}  // namespace halfspace::HS_LANES::procedural
