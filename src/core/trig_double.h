// SPDX-License-Identifier: Apache-2.0
//
// Sine and cosine in double precision for matrices and generators, bit-identical on every compiler and CPU. libm selects its
// code by CPU; these functions use only + − × and fma, which are correctly rounded.
//
// The angle is given as a fraction of a full turn, which makes the range reduction exact: quarter turns give exactly 0 and ±1.
#pragma once

#include <cmath>
#include <numbers>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

struct SinCosDouble {
  double sin, cos;
};

namespace detail {

// Taylor polynomials for the sine and cosine of hi + lo, with |hi| ≤ π/4 and |lo| ≤ ulp(hi). The first omitted term is below
// (π/4)^19/19! = 9e-20 for the sine and (π/4)^18/18! = 2e-18 for the cosine.
inline SinCosDouble sincos_small(double hi, double lo) {
  const double z = hi * hi;
  double s = 1.0 / 355687428096000.0;  // 1/17!
  s = std::fma(s, z, -1.0 / 1307674368000.0);
  s = std::fma(s, z, 1.0 / 6227020800.0);
  s = std::fma(s, z, -1.0 / 39916800.0);
  s = std::fma(s, z, 1.0 / 362880.0);
  s = std::fma(s, z, -1.0 / 5040.0);
  s = std::fma(s, z, 1.0 / 120.0);
  s = std::fma(s, z, -1.0 / 6.0);
  double c = 1.0 / 20922789888000.0;  // 1/16!
  c = std::fma(c, z, -1.0 / 87178291200.0);
  c = std::fma(c, z, 1.0 / 479001600.0);
  c = std::fma(c, z, -1.0 / 3628800.0);
  c = std::fma(c, z, 1.0 / 40320.0);
  c = std::fma(c, z, -1.0 / 720.0);
  c = std::fma(c, z, 1.0 / 24.0);
  // sin(hi + lo) ≈ sin hi + lo·(1 − z/2); cos(hi + lo) ≈ cos hi − hi·lo. The rounding error of 1 − z/2 is carried along.
  const double sin = hi + std::fma(hi * z, s, lo * std::fma(-0.5, z, 1.0));
  const double w = std::fma(-0.5, z, 1.0);
  const double error = std::fma(-0.5, z, 1.0 - w);
  const double cos = w + (error + std::fma(z * z, c, -hi * lo));
  return {sin, cos};
}

}  // namespace detail

/// Returns the sine and cosine of `turns` full turns (1 is 360°), within 1 ulp of the exact value. |turns| must be below 2^50.
inline SinCosDouble sincos_turns(double turns) {
  const double quarters = std::rint(4.0 * turns);
  const double rest = std::fma(-0.25, quarters, turns);  // exact, because |rest| ≤ 1/8 and rest is a multiple of ulp(turns)
  // 2π as the sum of two doubles; the second is 2π − (double)2π.
  constexpr double kHigh = 2.0 * std::numbers::pi;
  constexpr double kLow = 2.4492935982947064e-16;
  const double hi = kHigh * rest;
  const double lo = std::fma(kHigh, rest, -hi) + kLow * rest;
  const SinCosDouble r = detail::sincos_small(hi, lo);
  // Adding 0.0 turns a negative zero into a positive one.
  switch (static_cast<long long>(quarters) & 3) {
    case 0: return {r.sin + 0.0, r.cos + 0.0};
    case 1: return {r.cos + 0.0, -r.sin + 0.0};
    case 2: return {-r.sin + 0.0, -r.cos + 0.0};
    default: return {-r.cos + 0.0, r.sin + 0.0};
  }
}

/// Returns the sine and cosine of an angle in radians. The division by 2π adds one rounding.
inline SinCosDouble sincos_radians(double radians) { return sincos_turns(radians / (2.0 * std::numbers::pi)); }

}  // namespace halfspace::HS_LANES
