// SPDX-License-Identifier: Apache-2.0
//
// The angle and trigonometry functions (section 8.1) and the exponential functions (section 8.2) of GLSL 3.30, for scalars and vectors.
// Those of scalars are in lane_math.h and lane_hyperbolic.h, with their domains and error bounds, except for the ones defined here.
#pragma once

#include <numbers>

#include "halfspace/core/component_wise.h"
#include "halfspace/core/lane_hyperbolic.h"

namespace halfspace::HS_LANES {

/// Converts degrees to radians. The error is at most 0.63 ulp, unless the result is subnormal. GLSL 8.1.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto radians(const X& degrees) {
  return detail::map_numbers([]<class R>(R a) { return a * R(static_cast<float>(std::numbers::pi / 180)); }, degrees);
}
/// Converts radians to degrees. The error is at most 0.7 ulp. GLSL 8.1.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto degrees(const X& radians) {
  return detail::map_numbers([]<class R>(R a) { return a * R(static_cast<float>(180 / std::numbers::pi)); }, radians);
}

/// Sine of each component; see sin_cos. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> sin(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return sin(a); }, x);
}
/// Cosine of each component; see sin_cos. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> cos(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return cos(a); }, x);
}
/// Tangent of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> tan(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return tan(a); }, x);
}
/// Arc sine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> asin(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return asin(a); }, x);
}
/// Arc cosine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> acos(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return acos(a); }, x);
}
/// Arc tangent of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> atan(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return atan(a); }, x);
}
/// The angle of the point (x, y): atan2(y, x), which also states the error. GLSL 8.1.
template <class Y, class X>
requires detail::NumberArguments<Y, X> HS_INLINE auto atan(const Y& y, const X& x) {
  return detail::map_numbers([](auto a, auto b) { return atan2(a, b); }, y, x);
}
/// Hyperbolic sine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> sinh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return sinh(a); }, x);
}
/// Hyperbolic cosine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> cosh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return cosh(a); }, x);
}
/// Hyperbolic tangent of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> tanh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return tanh(a); }, x);
}
/// Inverse hyperbolic sine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> asinh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return asinh(a); }, x);
}
/// Inverse hyperbolic cosine of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> acosh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return acosh(a); }, x);
}
/// Inverse hyperbolic tangent of each component. GLSL 8.1.
template <int L, Number R>
HS_INLINE VecN<L, R> atanh(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return atanh(a); }, x);
}

/// Returns x^y for x >= 0, component by component; see pow of scalars. GLSL 8.2.
template <class X, class Y>
requires detail::NumberVectors<X, Y> HS_INLINE auto pow(const X& x, const Y& y) {
  return detail::map_numbers([](auto a, auto b) { return pow(a, b); }, x, y);
}
/// Returns e^x of each component. GLSL 8.2.
template <int L, Number R>
HS_INLINE VecN<L, R> exp(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return exp(a); }, x);
}
/// Natural logarithm of each component. GLSL 8.2.
template <int L, Number R>
HS_INLINE VecN<L, R> log(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return log(a); }, x);
}
/// Returns 2^x of each component. GLSL 8.2.
template <int L, Number R>
HS_INLINE VecN<L, R> exp2(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return exp2(a); }, x);
}
/// Base-2 logarithm of each component. GLSL 8.2.
template <int L, Number R>
HS_INLINE VecN<L, R> log2(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return log2(a); }, x);
}
/// Square root of each component, correctly rounded. GLSL 8.2.
template <int L, Number R>
HS_INLINE VecN<L, R> sqrt(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return sqrt(a); }, x);
}
/// Returns 1/sqrt(x) for every x: ±0 gives ±infinity and x < 0 gives NaN. The error is at most 1.5 ulp. inverse_sqrt is faster, for normal
/// numbers x > 0. GLSL 8.2.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto inversesqrt(const X& x) {
  return detail::map_numbers([]<class R>(R a) { return R(1) / sqrt(a); }, x);
}

}  // namespace halfspace::HS_LANES
