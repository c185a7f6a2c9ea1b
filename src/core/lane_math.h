// SPDX-License-Identifier: Apache-2.0
//
// Elementary functions with bit-identical results at every SIMD width, on every CPU and with every compiler: exp2 log2 exp log
// pow unit_pow inverse_sqrt sin cos tan atan2 atan asin acos. lane_hyperbolic.h adds the hyperbolic functions.
//
// A single template serves float and lanes of float. It uses only + − × ÷ sqrt, fma and bit operations, all of them correctly rounded, so
// each lane holds exactly what the scalar code would compute. libm is not used because it selects its code by CPU. For double, the
// functions call their std counterparts. They serve as the accuracy reference and are not guaranteed to be bit-identical. (x86-64-v2 has no
// fma instruction; fma then calls libm, which is also exact but slow.)
//
// Method: split off the exponent or the quadrant exactly (Cody and Waite, Software Manual for the Elementary Functions, 1980), then
// evaluate a minimax polynomial. The coefficients come from scripts/dev/fit_polynomials.py, which also prints the error of each fit. Error
// bounds are in ulps of the exact result; correct rounding has an error of at most 0.5 ulp. The bounds were measured over all floats of the
// domain, except for pow and atan2, which were measured on random pairs. tests/core/lane_math_test.cpp repeats part of the measurement. NaN
// inputs give NaN unless stated otherwise.
//
// Call these as halfspace::exp2(x), or from within namespace halfspace. Elsewhere an unqualified call with a float argument
// resolves to libm's function.
#pragma once

#include <array>
#include <limits>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace detail {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr int32_t kSignBit = std::numeric_limits<int32_t>::min();

/// Evaluates the sum of c[i]·x^i by Estrin's scheme, with a dependency chain of log2 N steps.
template <class R, std::size_t N>
HS_INLINE R estrin_polynomial(R x, const std::array<R, N>& c) {
  if constexpr (N == 1) {
    return c[0];
  } else {
    std::array<R, (N + 1) / 2> pairs;
    for (std::size_t i = 0; i < N / 2; ++i) pairs[i] = fma(c[2 * i + 1], x, c[2 * i]);
    if constexpr (N % 2 == 1) pairs[N / 2] = c[N - 1];
    return estrin_polynomial(x * x, pairs);
  }
}

/// Evaluates c[first] + c[first+1]·x + … + c[N−1]·x^(N−1−first). The last step, whose rounding dominates the error, is a Horner step.
template <std::size_t first = 0, class R, std::size_t N>
HS_INLINE R polynomial(R x, const float (&c)[N]) {
  std::array<R, N - 1 - first> rest;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = R(c[first + 1 + i]);
  return fma(estrin_polynomial(x, rest), x, R(c[first]));
}

/// Coefficients of 2^f for |f| <= 0.50001, and of log2(1 + f)/f for sqrt(1/2) <= 1 + f < sqrt(2).
inline constexpr float kExp2[] = {1.0f, 0.693147182f, 0.240226477f, 0.0555033237f, 0.00961843692f, 0.00133988773f, 0.000153533663f};
inline constexpr float kLog2[] = {1.44269502f,   -0.721347332f, 0.480898231f,  -0.360696584f, 0.288567483f,
                                  -0.239618421f, 0.204600647f,  -0.191055983f, 0.186170802f,  -0.109957926f};

/// Returns p·2^n rounded once, including subnormal results, for 0.5 < p < 2 and −200 < n < 200. The power is applied as two
/// factors because 2^n itself may not be representable; the first product is exact.
template <class R>
HS_INLINE R scale(R p, IntOf<R> n) {
  const IntOf<R> half = n >> 1;
  return p * as_real((half + 127) << 23) * as_real((n - half + 127) << 23);
}

/// Returns 2^f for |f| <= 0.50001.
template <class R>
HS_INLINE R exp2_of_fraction(R f) {
  return fma(f, polynomial<1>(f, kExp2), R(1.0f));
}

/// Represents x = m·2^e with sqrt(1/2) <= m < sqrt(2), for 0 < x < infinity.
template <class R>
struct MantissaExponent {
  R m;
  IntOf<R> e;
};
/// Splits a normal number 2^-126 <= x < infinity.
template <class R>
HS_INLINE MantissaExponent<R> split_normal(R x) {
  const IntOf<R> root_half = 0x3f3504f3;                    // the bits of sqrt(1/2)
  const IntOf<R> i = (as_int(x) & 0x7fffffff) - root_half;  // clearing the sign avoids an overflow for x < 0
  return {as_real((i & 0x7fffff) + root_half), i >> 23};
}
/// Returns log2(x) for 2^-126 <= x < infinity, where c is a polynomial for log2(1 + f)/f. With x = m·2^e, the error of the polynomial is
/// relative to log2(m). Zero and subnormal x give an unspecified number below −125; infinity and NaN give an unspecified number of at least
/// 128.
template <class R, std::size_t N>
HS_INLINE R log2_of_normal(R x, const float (&c)[N]) {
  const MantissaExponent<R> me = split_normal(x);
  const R f = me.m - R(1.0f);
  return fma(f, polynomial(f, c), to_real<R>(me.e));
}
/// Splits any number 0 < x < infinity, including subnormals.
template <class R>
HS_INLINE MantissaExponent<R> split(R x) {
  const MaskOf<R> subnormal = x < R(0x1p-126f);
  const MantissaExponent<R> me = split_normal(select(subnormal, x * R(0x1p23f), x));
  return {me.m, me.e - select(subnormal, IntOf<R>(23), IntOf<R>(0))};
}

/// Handles the special cases of logarithms: log 0 = −inf and log inf = inf; negative x and NaN give NaN.
template <class R>
HS_INLINE R with_log_special_cases(R x, R log_x) {
  const R special = select(x == R(0.0f), R(-kInfinity), select(x > R(0.0f), R(kInfinity), R(kNaN)));
  return select(x > R(0.0f) && x < R(kInfinity), log_x, special);
}

/// An unevaluated sum high + low, where |low| is at most about one ulp of high. Holds about 45 bits.
template <class R>
struct Sum {
  R high, low;
};

/// Returns log2(x) with a relative error below 2^-34, for 0 < x < infinity.
///
/// With s = (m − 1)/(m + 1), log2(m) = (2/ln 2)·(s + s³/3 + s⁵/5 + …) = s·(c + u), u = s²·(c1 + s²·(c2 + …)) < c/100. The
/// rounding error of each significant product and sum is kept; it is computed exactly with fma or Dekker's fast two-sum.
template <class R>
HS_INLINE Sum<R> log2_in_two(R x) {
  static constexpr float kC[] = {0.577082872f, 0.411706328f, 0.340218514f};
  static constexpr float kC0 = 2.88539004f, kC0Low = 3.85192607e-08f, kC1 = 0.961796701f, kC1Low = -2.17613092e-08f;
  const MantissaExponent<R> me = split(x);
  const R f = me.m - R(1.0f);  // exact
  const R d = me.m + R(1.0f);
  const R d_low = me.m - (d - R(1.0f));
  const R d_inverse = R(1.0f) / d;
  const R s = f * d_inverse;
  const R s_low = fma(-s, d_low, fma(-s, d, f)) * d_inverse;
  const R z = s * s;
  const R z_low = fma(s, s, -z) + R(2.0f) * s * s_low;
  const R tail = z * polynomial(z, kC);
  const R p = R(kC1) + tail;
  const R p_low = (R(kC1) - p) + tail + R(kC1Low);
  const R u = z * p;
  const R u_low = fma(z, p, -u) + fma(z, p_low, z_low * p);
  const R g = R(kC0) + u;
  const R g_low = (R(kC0) - g) + u + (R(kC0Low) + u_low);
  const R l = s * g;
  const R l_low = fma(s, g, -l) + fma(s, g_low, s_low * g);
  const R e = to_real<R>(me.e);
  const R high = e + l;  // fast two-sum is valid: |e| >= 1 > |l|, or e = 0
  return {high, (e - high) + l + l_low};
}

template <class R>
HS_INLINE R copy_sign_bits(R magnitude, IntOf<R> sign) {
  return as_real(as_int(magnitude) ^ (sign & kSignBit));
}

}  // namespace detail

/// Returns 2^x. The error is at most 0.96 ulp, even for subnormal results; integers give exact results. Returns 0 for x < −150
/// and infinity for x >= 128.
template <Number R>
HS_INLINE R exp2(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::exp2(x);
  else {
    const R clamped = clamp(x, -160.0f, 160.0f);
    const R n = round_even(clamped);
    const R r = detail::scale(detail::exp2_of_fraction(clamped - n), round_to_int(n));
    return select(x == x, r, x);
  }
}

namespace detail {

/// Returns e^x·2^k for |k| <= 1, rounded like e^x.
template <class R>
HS_INLINE R exp_times_power_of_two(R x, int32_t k) {
  static constexpr float kC[] = {0.49999994f, 0.166665211f, 0.041668389f, 0.00836871099f, 0.00138146093f};
  const R clamped = clamp(x, -110.0f, 110.0f);
  const R n = round_even(clamped * R(1.44269502f));
  const R f = fma(-n, R(1.42860677e-06f), fma(-n, R(0.693145752f), clamped));  // ln 2 is split in two; the first step is exact
  const R p = fma(f * f, polynomial(f, kC), f) + R(1.0f);
  return select(x == x, scale(p, round_to_int(n) + k), x);
}

}  // namespace detail

/// Returns e^x. The error is at most 1.02 ulp. Returns 0 for x < −104 and infinity for x > 88.8.
template <Number R>
HS_INLINE R exp(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::exp(x);
  else
    return detail::exp_times_power_of_two(x, 0);
}

/// Returns the base-2 logarithm. The error is at most 1.04 ulp; powers of two give exact results. log2(±0) = −inf,
/// log2(inf) = inf, and x < 0 gives NaN.
template <Number R>
HS_INLINE R log2(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::log2(x);
  else {
    const detail::MantissaExponent<R> me = detail::split(x);
    const R f = me.m - R(1.0f);
    const R tail = f * fma(f, detail::polynomial<1>(f, detail::kLog2), R(1.92596303e-08f));  // the low part of 1/ln 2
    return detail::with_log_special_cases(x, to_real<R>(me.e) + fma(f, R(detail::kLog2[0]), tail));
  }
}

/// Returns the natural logarithm. The error is at most 0.9 ulp. Zero, infinity and x < 0 are handled as in log2.
template <Number R>
HS_INLINE R log(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::log(x);
  else {
    static constexpr float kC[] = {-0.499999881f, 0.333333254f,  -0.250015825f, 0.200019732f,  -0.166090831f,
                                   0.141818359f,  -0.132429913f, 0.129043773f,  -0.0762170255f};
    const detail::MantissaExponent<R> me = detail::split(x);
    const R f = me.m - R(1.0f);
    const R e = to_real<R>(me.e);
    const R low = fma(f * f, detail::polynomial(f, kC), e * R(1.42860677e-06f));
    return detail::with_log_special_cases(x, fma(e, R(0.693145752f), f + low));
  }
}

/// Returns x^y for x >= 0 and any y. The error is at most 1.2 ulp wherever the result is representable, including subnormal
/// results (the largest error found is 1.07 ulp).
///
/// pow(x, 0) = 1 and pow(1, y) = 1 for every x and y, including NaN. pow(0, y) is 0 for y > 0 and infinity for y < 0.
/// Infinities follow IEEE 754. Unlike std::pow, x < 0 gives NaN for every y except 0, even if y is an integer, and −0 is
/// treated as 0. R = double follows the same rules.
template <Number R>
HS_INLINE R pow(R x, std::type_identity_t<R> y) {
  if constexpr (std::is_same_v<R, double>) {
    return x < 0.0 && y != 0.0 ? static_cast<double>(detail::kNaN) : std::pow(x == 0.0 ? 0.0 : x, y);
  } else {
    const detail::Sum<R> log_x = detail::log2_in_two(x);
    const R special = select(x > R(0.0f), R(detail::kInfinity), R(-detail::kInfinity));
    const R high = select(x > R(0.0f) && x < R(detail::kInfinity), log_x.high, special);
    const R product = y * high;
    // The remainder of y·log2(x). It may be NaN where the product is far out of range, and is not needed there.
    const R rest = select(abs(product) < R(200.0f), fma(y, high, -product) + y * log_x.low, R(0.0f));
    const R clamped = clamp(product, -200.0f, 200.0f);
    const R n = round_even(clamped);
    const R power = detail::scale(detail::exp2_of_fraction((clamped - n) + rest), round_to_int(n));
    const R r = select(x >= R(0.0f) && y == y, power, R(detail::kNaN));
    return select(x == R(1.0f) || y == R(0.0f), R(1.0f), r);
  }
}

/// Returns x^y for 0 <= x <= 1 and y >= 0, as needed for specular highlights. Measured in isolation with 16 lanes, it takes a
/// fifth of the time of pow. The absolute error is at most 6e-7 (pow bounds the relative error). unit_pow(x, 0) = 1 for every x,
/// even NaN, and unit_pow(0, y) = 0 for y > 0. Otherwise NaN gives NaN. x < 2^-126 is treated as 0.
///
/// Error bound: let t = −y·log2(x). t has a relative error of 2^-19.8, so the result 2^-t has an absolute error of
/// ln 2·t·2^-t·2^-19.8 <= 4.1e-7, because t·2^-t is at most 0.54. The polynomial for the power of two adds a relative error of
/// 1.1e-7. Together these are at most 4.6e-7; rounding adds about 1e-7.
template <Number R>
HS_INLINE R unit_pow(R x, std::type_identity_t<R> y) {
  if constexpr (std::is_same_v<R, double>) {
    return pow(x, y);
  } else {
    static constexpr float kCoarseLog2[] = {1.44269645f,  -0.721363604f, 0.480626762f, -0.359371722f,
                                            0.295699507f, -0.269319504f, 0.171623692f};
    static constexpr float kCoarseExp2[] = {1.0f, 0.693147004f, 0.240222424f, 0.0555073358f, 0.00967151485f, 0.00132647296f};
    const R product = max(R(-125.0f), y * detail::log2_of_normal(x, kCoarseLog2));
    const R shifted = product + R(0x1.8p23f);  // the low mantissa bits now hold the nearest integer
    const R power_of_two = as_real((as_int(shifted) + 127) << 23);
    const R r = detail::polynomial(product - (shifted - R(0x1.8p23f)), kCoarseExp2) * power_of_two;
    return select(y == R(0.0f), R(1.0f), select(x >= R(0x1p-126f), r, x - x));
  }
}

/// Returns 1/sqrt(x) for 2^-126 <= x < infinity, with an error of at most 1.32 ulp. It is cheaper than a square root and a
/// division, and leaves the divider free for other instructions. Subnormal x > 0 give a finite number below 1/sqrt(x); other
/// inputs give meaningless results.
///
/// The first guess y halves the exponent (see Moroz et al., "Fast calculation of inverse square root with the use of magic
/// constant", 2016). r = 1 − x·y² is then within 0.07 of 0, and the result is y/sqrt(1 − r), evaluated as a polynomial in r.
template <Number R>
HS_INLINE R inverse_sqrt(R x) {
  if constexpr (std::is_same_v<R, double>) {
    return 1.0 / std::sqrt(x);
  } else {
    static constexpr float kC[] = {0.499998331f, 0.375000268f, 0.31393671f, 0.274112403f};
    const R guess = as_real(IntOf<R>(0x5f3759df) - (as_int(x) >> 1));
    const R rest = fma(-(x * guess), guess, R(1.0f));
    return fma(guess * rest, detail::polynomial(rest, kC), guess);
  }
}

/// Sine and cosine of the same angle.
template <class R>
struct SinCos {
  R sin, cos;
};

/// Returns the sine and cosine of x radians. For |x| <= 1e4 the error is at most 1.54 ulp, even near zeros of the functions:
/// π/2 is subtracted in three parts, the first of them without rounding. For |x| <= 1e6 the absolute error is below 1e-6. Beyond
/// that the results are in [−1, 1] but meaningless. ±infinity gives NaN. sin is exactly odd (sin(−0) = −0) and cos exactly even.
template <Number R>
HS_INLINE SinCos<R> sin_cos(R x) {
  if constexpr (std::is_same_v<R, double>)
    return {std::sin(x), std::cos(x)};
  else {
    static constexpr float kSin[] = {-0.166666552f, 0.00833215564f, -0.00019514632f};
    static constexpr float kCos[] = {0.0416666456f, -0.00138873095f, 2.44324128e-05f};
    const R a = abs(x);
    const R n = round_even(a * R(0.636619772f));
    R r = fma(-n, R(1.57079637f), a);
    r = fma(-n, R(-4.37113883e-08f), r);
    r = fma(-n, R(-1.71512451e-15f), r);
    r = clamp(r, -1.0f, 1.0f);  // has an effect only if |x| is out of range
    const R z = r * r;
    const R s = fma(r * z, detail::polynomial(z, kSin), r);
    const R c = fma(z, fma(z, detail::polynomial(z, kCos), R(-0.5f)), R(1.0f));
    const IntOf<R> quadrant = round_to_int(n);
    const MaskOf<R> swap = (quadrant & 1) != 0;
    const R sin = detail::copy_sign_bits(select(swap, c, s), as_int(x) ^ (quadrant << 30));
    const R cos = detail::copy_sign_bits(select(swap, s, c), (quadrant + 1) << 30);
    const MaskOf<R> finite = a < R(detail::kInfinity);
    return {select(finite, sin, R(detail::kNaN)), select(finite, cos, R(detail::kNaN))};
  }
}
template <Number R>
HS_INLINE R sin(R x) {
  return sin_cos(x).sin;
}
template <Number R>
HS_INLINE R cos(R x) {
  return sin_cos(x).cos;
}
/// Returns sin(x)/cos(x). For |x| <= 1e4 the error is at most 3.33 ulp, even near zeros and poles. Otherwise as sin_cos.
template <Number R>
HS_INLINE R tan(R x) {
  if constexpr (std::is_same_v<R, double>) {
    return std::tan(x);
  } else {
    const SinCos<R> of = sin_cos(x);
    return of.sin / of.cos;
  }
}

/// Returns the angle of the point (x, y) in [−π, π], with the sign of y. The error is at most 1.5 ulp (the largest error found
/// is 1.39). Zeros and infinities follow IEEE 754: atan2(±0, +0) = ±0, atan2(±0, −0) = ±π, atan2(±inf, inf) = ±π/4.
template <Number R>
HS_INLINE R atan2(R y, std::type_identity_t<R> x) {
  if constexpr (std::is_same_v<R, double>)
    return std::atan2(y, x);
  else {
    static constexpr float kC[] = {
        -0.333332986f, 0.199985474f,   -0.142642379f, 0.10952165f,    -0.0840339512f,
        0.0579567254f, -0.0311770439f, 0.0109142046f, -0.00179352728f};  // the last is adjusted by 1e-8 so that atan(1) is π/4
    const R ax = abs(x), ay = abs(y);
    const MaskOf<R> steep = ay > ax;
    const MaskOf<R> left = as_int(x) < 0;  // −0 is left of the y axis
    const R low = select(steep, ax, ay), high = select(steep, ay, ax);
    const R diagonal = select(high > R(0.0f), R(1.0f), R(0.0f));  // replaces 0/0 and inf/inf
    const R t = select(low == high, diagonal, low / high);
    const R z = t * t;
    const R r = fma(t * z, detail::polynomial(z, kC), t);  // atan(t) for 0 <= t <= 1
    const R from = select(steep, R(1.57079637f), select(left, R(3.14159274f), R(0.0f)));
    const R from_low = from * R(-2.78275e-08f);  // π/2 and π minus their float values
    const R angle = from + (select(steep ^ left, -r, r) + from_low);
    return detail::copy_sign_bits(angle, as_int(y));
  }
}

/// Returns the arc tangent in [−π/2, π/2]. The error is at most 1.4 ulp.
template <Number R>
HS_INLINE R atan(R x) {
  return atan2(x, R(1.0f));
}

namespace detail {

/// Returns (asin(s) − s)/s³ for s² = z <= 1/4.
template <class R>
HS_INLINE R asin_tail(R z) {
  static constexpr float kC[] = {0.166667521f, 0.0749529749f, 0.0454703756f, 0.0241795238f, 0.0421662852f};
  return polynomial(z, kC);
}

}  // namespace detail

/// Returns the arc sine in [−π/2, π/2]. The error is at most 2.37 ulp; |x| > 1 gives NaN. For x > 1/2 it uses
/// asin(x) = π/2 − 2·asin(sqrt((1 − x)/2)).
template <Number R>
HS_INLINE R asin(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::asin(x);
  else {
    const R a = abs(x);
    const MaskOf<R> outer = a > R(0.5f);
    const R z = select(outer, (R(1.0f) - a) * R(0.5f), a * a);
    const R s = select(outer, sqrt(z), a);
    const R r = fma(s * z, detail::asin_tail(z), s);
    return detail::copy_sign_bits(select(outer, R(1.57079637f) - (R(2.0f) * r + R(4.37113883e-08f)), r), as_int(x));
  }
}

/// Returns the arc cosine in [0, π]. The error is at most 1.13 ulp; |x| > 1 gives NaN.
template <Number R>
HS_INLINE R acos(R x) {
  if constexpr (std::is_same_v<R, double>)
    return std::acos(x);
  else {
    const R a = abs(x);
    const MaskOf<R> outer = a > R(0.5f);
    const R z = select(outer, (R(1.0f) - a) * R(0.5f), a * a);
    const R s = select(outer, sqrt(z), a);
    const R r = fma(s * z, detail::asin_tail(z), s);
    const R inner = R(1.57079637f) - (detail::copy_sign_bits(r, as_int(x)) + R(4.37113883e-08f));
    const R twice = R(2.0f) * r;
    const R ends = select(x < R(0.0f), R(3.14159274f) - (twice + R(8.74227766e-08f)), twice);
    return select(outer, ends, inner);
  }
}

}  // namespace halfspace::HS_LANES
