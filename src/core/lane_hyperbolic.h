// SPDX-License-Identifier: Apache-2.0
//
// Hyperbolic functions and their inverses: sinh cosh tanh asinh acosh atanh. Like lane_math.h, they give bit-identical results at every
// SIMD width. For double, they call their std counterparts.
//
// Where the formula with exponentials or logarithms cancels, near zero, a minimax polynomial from scripts/dev/fit_polynomials.py takes its
// place. The error bounds were measured over all floats of the domain; tests/core/lane_hyperbolic_test.cpp repeats part of the measurement.
#pragma once

#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Returns x + x³·p(x²), where p has the coefficients c.
template <class R, std::size_t N>
HS_INLINE R odd_polynomial(R x, const float (&c)[N]) {
  const R z = x * x;
  return fma(x * z, polynomial(z, c), x);
}

/// Returns log(1 + x) for x >= −1, and NaN for x < −1. log(u) of the rounded sum u = 1 + x is corrected by the rounding error divided by u.
template <class R>
HS_INLINE R log_of_one_plus(R x) {
  const R u = R(1) + x;
  const R lost = select(x < R(1), x - (u - R(1)), R(1) - (u - x));
  const R corrected = log(u) + lost / u;
  return select(u > R(0) && u < R(kInfinity), select(abs(x) < R(0x1p-24f), x, corrected), log(u));
}

/// From here on, sqrt(x² ± 1) is x to within a quarter of an ulp, and x² does not overflow below.
inline constexpr float kLargeForSquare = 8192.0f;
inline constexpr float kLn2 = 0.693147182f;

}  // namespace detail

/// Returns (e^x − e^−x)/2. The error is at most 1.62 ulp. sinh is odd, with sinh(−0) = −0, and overflows to infinity for |x| > 89.4.
template <Number R>
HS_INLINE R sinh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::sinh(x);
  else {
    static constexpr float kC[] = {0.166666672f, 0.0083333496f, 0.000198361595f, 2.81695134e-06f};  // for |x| <= 1
    const R a = abs(x), half_exp = detail::exp_times_power_of_two(a, -1);
    const R size = select(a < R(1), detail::odd_polynomial(a, kC), half_exp - R(0.25f) / half_exp);
    return detail::copy_sign_bits(size, as_int(x));
  }
}

/// Returns (e^x + e^−x)/2. The error is at most 1.46 ulp. Overflows to infinity for |x| > 89.4.
template <Number R>
HS_INLINE R cosh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::cosh(x);
  else {
    const R half_exp = detail::exp_times_power_of_two(abs(x), -1);
    return half_exp + R(0.25f) / half_exp;
  }
}

/// Returns sinh(x)/cosh(x) in [−1, 1]. The error is at most 1.34 ulp. tanh is odd, with tanh(−0) = −0.
template <Number R>
HS_INLINE R tanh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::tanh(x);
  else {
    static constexpr float kC[] = {-0.333332986f, 0.133319244f, -0.0537838265f, 0.0207959637f, -0.00589514989f};  // for |x| <= 0.6
    const R a = abs(x), large = R(1) - R(2) / (exp(R(2) * a) + R(1));
    return detail::copy_sign_bits(select(a < R(0.6f), detail::odd_polynomial(a, kC), large), as_int(x));
  }
}

/// Returns the inverse of sinh. The error is at most 2.07 ulp. asinh is odd, with asinh(−0) = −0.
template <Number R>
HS_INLINE R asinh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::asinh(x);
  else {
    const R a = abs(x), square = a * a;
    const R small = detail::log_of_one_plus(a + square / (R(1) + sqrt(square + R(1))));
    return detail::copy_sign_bits(select(a < R(detail::kLargeForSquare), small, log(a) + R(detail::kLn2)), as_int(x));
  }
}

/// Returns the inverse of cosh, which is not negative. The error is at most 2.89 ulp; x < 1 gives NaN.
template <Number R>
HS_INLINE R acosh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::acosh(x);
  else {
    const R t = x - R(1);
    const R small = detail::log_of_one_plus(t + sqrt(t * (t + R(2))));
    const R r = select(x < R(detail::kLargeForSquare), small, log(x) + R(detail::kLn2));
    return select(x >= R(1), r, R(detail::kNaN));
  }
}

/// Returns the inverse of tanh. The error is at most 2.52 ulp; ±1 gives ±infinity, and |x| > 1 gives NaN. atanh(−0) = −0.
template <Number R>
HS_INLINE R atanh(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::atanh(x);
  else {
    const R a = abs(x);
    return detail::copy_sign_bits(R(0.5f) * detail::log_of_one_plus(R(2) * a / (R(1) - a)), as_int(x));
  }
}

}  // namespace halfspace::HS_LANES
