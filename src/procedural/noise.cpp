// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/noise.h"

#include <algorithm>
#include <type_traits>

#include "halfspace/core/hash.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::HS_LANES::procedural {

namespace {

// SIMD lanes wrap on overflow. A plain int (SIMD width 1) needs unsigned arithmetic for that.
template <class I>
HS_INLINE I wrapping_add(I a, int32_t b) {
  if constexpr (std::is_same_v<I, int32_t>) {
    return static_cast<int32_t>(static_cast<uint32_t>(a) + static_cast<uint32_t>(b));
  } else {
    return a + I(b);
  }
}

// The top bits of the result depend on all bits of h.
HS_INLINE Int scramble(Int h) { return wrapping_mul(h ^ (h >> 15), 0x2c1b3c6d); }

// Returns the dot product of (x, y, z) with one of the eight directions (±1, ±1, ±1), chosen by the top three bits of the hash.
HS_INLINE Real gradient(Int hash, Real x, Real y, Real z) {
  const Int sign(INT32_MIN);
  return as_real(as_int(x) ^ (hash & sign)) + as_real(as_int(y) ^ ((hash << 1) & sign)) + as_real(as_int(z) ^ ((hash << 2) & sign));
}

HS_INLINE Real fade(Real t) { return t * t * t * fma(t, fma(t, Real(6.0f), Real(-15.0f)), Real(10.0f)); }

// Maps a point to the next octave: scaled by nearly two, so that the lattices do not line up, rotated and translated.
HS_INLINE Vec next_octave(const Vec& p) {
  return Vec(fma(p.x, Real(1.624f), fma(p.y, Real(-0.974f), Real(17.3f))),
             fma(p.x, Real(0.771f), fma(p.y, Real(1.285f), fma(p.z, Real(-1.304f), Real(-9.7f)))),
             fma(p.x, Real(0.635f), fma(p.y, Real(1.058f), fma(p.z, Real(1.584f), Real(5.1f)))));
}

}  // namespace

Real noise(const Vec& p, int32_t seed) {
  const Vec cell(floor(p.x), floor(p.y), floor(p.z));
  const Vec f = p - cell;
  const Int x0 = wrapping_mul(truncate_to_int(cell.x), 0x1b873593);
  const Int y0 = wrapping_mul(truncate_to_int(cell.y), 0x19d699a5);
  const Int z0 = wrapping_add(wrapping_mul(truncate_to_int(cell.z), 0x3c6ef372), seed);
  const Int x1 = wrapping_add(x0, 0x1b873593);
  const Int y1 = wrapping_add(y0, 0x19d699a5);
  const Int z1 = wrapping_add(z0, 0x3c6ef372);
  const Vec g = f - Vec(Real(1.0f));
  const Real u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const auto edge = [&](Int yz, Real fy, Real fz) {
    return lerp(gradient(scramble(x0 ^ yz), f.x, fy, fz), gradient(scramble(x1 ^ yz), g.x, fy, fz), u);
  };
  const Real near = lerp(edge(y0 ^ z0, f.y, f.z), edge(y1 ^ z0, g.y, f.z), v);
  const Real far = lerp(edge(y0 ^ z1, f.y, g.z), edge(y1 ^ z1, g.y, g.z), v);
  return lerp(near, far, w);
}

Real cloud(Vec p, int octaves, int32_t seed) {
  Real sum(0.0f);
  float strength = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += Real(strength) * noise(p, seed + i);
    strength *= 0.5f;
    p = next_octave(p);
  }
  return sum;
}

Real ridges(Vec p, int octaves, int32_t seed) {
  Real sum(0.0f), crest(1.0f);
  float strength = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    const Real r = max(Real(1.0f) - Real(1.6f) * abs(noise(p, seed + i)), Real(0.0f));
    crest = r * r * min(Real(2.0f) * crest, Real(1.0f));  // fine crests only on top of coarse ones
    sum += Real(strength) * crest;
    strength *= 0.5f;
    p = next_octave(p);
  }
  return sum;
}

namespace {

// Returns the coordinate of a lattice point modulo the period. Exact, because both are small integers.
HS_INLINE Real modulo(Real x, Real period) { return x - period * floor(x / period); }

// Returns the dot product of (x, y) with one of eight directions, 45° apart and of length √2.
HS_INLINE Real plane_gradient(Int hash, Real x, Real y) {
  const Int sign(INT32_MIN);
  const Real a = as_real(as_int(x) ^ (hash & sign)), b = as_real(as_int(y) ^ ((hash << 1) & sign));
  const Real straight = Real(1.41421356f) * select((hash & 0x10000000) == 0, a, b);
  return select((hash & 0x08000000) == 0, a + b, straight);
}

// Calls octave(noise, strength) from coarse to fine. Each octave is shifted so that lattices do not line up.
template <class F>
void for_each_octave(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed, F octave) {
  float strength = 1.0f;
  Real x = u * Real(static_cast<float>(period_u)), y = v * Real(static_cast<float>(period_v));
  for (int i = 0; i < octaves && 2 * std::max(period_u, period_v) <= texels; ++i) {
    octave(tiled_noise(x, y, period_u, period_v, seed + i), strength);
    strength *= 0.5f;
    x = fma(x, Real(2.0f), Real(0.37f));
    y = fma(y, Real(2.0f), Real(0.61f));
    period_u *= 2;
    period_v *= 2;
  }
}

}  // namespace

Real tiled_noise(Real x, Real y, int period_x, int period_y, int32_t seed) {
  const Real cell_x = floor(x), cell_y = floor(y);
  const Real px(static_cast<float>(period_x)), py(static_cast<float>(period_y));
  const auto column = [&](Real c) { return wrapping_mul(truncate_to_int(modulo(c, px)), 0x1b873593); };
  const auto row = [&](Real c) { return wrapping_add(wrapping_mul(truncate_to_int(modulo(c, py)), 0x19d699a5), seed); };
  const Int x0 = column(cell_x), x1 = column(cell_x + Real(1.0f)), y0 = row(cell_y), y1 = row(cell_y + Real(1.0f));
  const Real fx = x - cell_x, fy = y - cell_y, gx = fx - Real(1.0f), gy = fy - Real(1.0f);
  const Real a = fade(fx), b = fade(fy);
  const Real top = lerp(plane_gradient(scramble(x0 ^ y0), fx, fy), plane_gradient(scramble(x1 ^ y0), gx, fy), a);
  const Real bottom = lerp(plane_gradient(scramble(x0 ^ y1), fx, gy), plane_gradient(scramble(x1 ^ y1), gx, gy), a);
  return lerp(top, bottom, b);
}

Real tiled_cloud(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed) {
  Real sum(0.0f);
  for_each_octave(u, v, period_u, period_v, octaves, texels, seed,
                  [&](Real noise, float strength) { sum = fma(Real(strength), noise, sum); });
  return sum;
}

Real tiled_ridges(Real u, Real v, int period_u, int period_v, int octaves, int texels, int32_t seed) {
  Real sum(0.0f), crest(1.0f);
  for_each_octave(u, v, period_u, period_v, octaves, texels, seed, [&](Real noise, float strength) {
    const Real r = max(Real(1.0f) - Real(1.6f) * abs(noise), Real(0.0f));
    crest = r * r * min(Real(2.0f) * crest, Real(1.0f));  // fine crests only on top of coarse ones
    sum = fma(Real(strength), crest, sum);
  });
  return sum;
}

Longitudes longitudes_of(int width) {
  const std::size_t padded = static_cast<std::size_t>((width + kLanes - 1) / kLanes * kLanes);
  Longitudes l{std::vector<float>(padded), std::vector<float>(padded)};
  for (std::size_t x = 0; x < padded; ++x) {
    const SinCosDouble a = sincos_turns((static_cast<double>(x) + 0.5) / width);
    l.cos[x] = static_cast<float>(a.cos);
    l.minus_sin[x] = static_cast<float>(-a.sin);
  }
  return l;
}

}  // namespace halfspace::HS_LANES::procedural
