// SPDX-License-Identifier: Apache-2.0
//
// The common functions of GLSL 3.30, section 8.3, and those that GLSL 4.x adds to it (fma, frexp, ldexp), for scalars and vectors.
//
// Where GLSL accepts a scalar in place of a vector, these accept one in place of any vector argument. Each is evaluated as its comment
// says, with every operation correctly rounded, so that lanes and scalars give the same bits. abs, floor, min, max and clamp of scalars are
// in lanes.h.
#pragma once

#include "halfspace/core/discrete_vec.h"
#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Returns the magnitude m >= 0 with the sign of s.
template <class R>
HS_INLINE R with_sign_of(R m, R s) {
  if constexpr (std::is_same_v<R, double>) {
    return std::copysign(m, s);
  } else {
    return as_real(as_int(m) | (as_int(s) & kSignBit));
  }
}

template <class X>
concept SignedIntegers = IntegerArguments<X> && kIsInt<ComponentOf<X>>;

}  // namespace detail

/// Absolute value, exact; |INT32_MIN| wraps. GLSL 8.3.
template <int L, Number R>
HS_INLINE VecN<L, R> abs(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return abs(a); }, x);
}
template <detail::SignedIntegers X>
HS_INLINE auto abs(const X& x) {
  return detail::map_integers([](auto a) { return max(a, detail::wrapping(decltype(a)(0), a, std::minus())); }, x);
}

/// Returns 1, 0 or −1, exact; NaN gives 0. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> || detail::SignedIntegers<X> HS_INLINE auto sign(const X& x) {
  return detail::map_as<detail::ComponentOf<X>>([]<class R>(R a) { return select(a > R(0), R(1), select(a < R(0), R(-1), R(0))); }, x);
}

/// Rounds down, exact. GLSL 8.3.
template <int L, Number R>
HS_INLINE VecN<L, R> floor(const VecN<L, R>& x) {
  return detail::map_as<R>([](R a) { return floor(a); }, x);
}
/// Rounds towards zero, exact; keeps the sign of zero. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto trunc(const X& x) {
  return detail::map_numbers([](auto a) { return detail::with_sign_of(floor(abs(a)), a); }, x);
}
/// Rounds to the nearest integer, and halves away from zero, exact. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto round(const X& x) {
  return detail::map_numbers(
      []<class R>(R a) {
        const R size = abs(a), below = floor(size);
        return detail::with_sign_of(below + select(size - below >= R(0.5f), R(1), R(0)), a);
      },
      x);
}
/// Rounds to the nearest integer, and halves to the even one, exact. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto roundEven(const X& x) {
  return detail::map_numbers([](auto a) { return round_even(a); }, x);
}
/// Rounds up, exact; keeps the sign of zero. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto ceil(const X& x) {
  return detail::map_numbers([](auto a) { return -floor(-a); }, x);
}
/// Returns x − floor(x), correctly rounded, in [0, 1]: it rounds to 1 for tiny negative x. Infinities give NaN. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto fract(const X& x) {
  return detail::map_numbers([](auto a) { return a - floor(a); }, x);
}

/// Returns x − y·floor(x/y), which has the sign of y. Correctly rounded for |x/y| < 2^22; beyond, floor(x/y) itself is rounded. y = 0 and
/// infinities give NaN. GLSL 8.3.
template <class X, class Y>
requires detail::NumberArguments<X, Y> HS_INLINE auto mod(const X& x, const Y& y) {
  return detail::map_numbers(
      []<class R>(R a, R b) {
        const R rest = fma(-b, floor(a / b), a);
        // Where a/b rounds up to an integer, the quotient is one too large and the rest has the wrong sign.
        return select((rest < R(0) && b > R(0)) || (rest > R(0) && b < R(0)), rest + b, rest);
      },
      x, y);
}
/// Splits x into the integer part i and the fraction, which is returned. Both have the sign of x. Exact. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE X modf(const X& x, X& i) {
  const X fraction = detail::map_numbers(  // before i is set, which may be x
      []<class R>(R a) {
        const R size = abs(a);
        return detail::with_sign_of(select(size == R(detail::kInfinity), R(0), size - floor(size)), a);
      },
      x);
  i = trunc(x);
  return fraction;
}

/// The smaller argument, exact; if either is NaN, the second. GLSL 8.3.
template <class X, class Y>
requires detail::NumberVectors<X, Y> || detail::IntegerVectors<X, Y> HS_INLINE auto min(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return min(a, b); }, x, y);
}
/// The larger argument, exact; if either is NaN, the second. GLSL 8.3.
template <class X, class Y>
requires detail::NumberVectors<X, Y> || detail::IntegerVectors<X, Y> HS_INLINE auto max(const X& x, const Y& y) {
  return detail::map_alike([](auto a, auto b) { return max(a, b); }, x, y);
}
/// Returns min(max(x, low), high), exact; NaN gives low. GLSL 8.3.
template <class X, class Low, class High>
requires detail::NumberVectors<X, Low, High> || detail::IntegerArguments<X, Low, High> HS_INLINE auto clamp(const X& x, const Low& low,
                                                                                                            const High& high) {
  return detail::map_alike([](auto a, auto b, auto c) { return min(max(a, b), c); }, x, low, high);
}
// More specialized than std::min, std::max and std::clamp, also after `using namespace std`.
template <int L, Number R>
HS_INLINE VecN<L, R> min(const VecN<L, R>& x, const VecN<L, R>& y) {
  return detail::map_as<R>([](R a, R b) { return min(a, b); }, x, y);
}
template <int L, Number R>
HS_INLINE VecN<L, R> max(const VecN<L, R>& x, const VecN<L, R>& y) {
  return detail::map_as<R>([](R a, R b) { return max(a, b); }, x, y);
}
template <int L, Number R>
HS_INLINE VecN<L, R> clamp(const VecN<L, R>& x, const VecN<L, R>& low, const VecN<L, R>& high) {
  return min(max(x, low), high);
}

/// Returns x·(1 − a) + y·a, with four roundings. The version with vectors x and y and a scalar a is in vec.h. GLSL 8.3.
template <class X, class Y, class A>
requires detail::NumberArguments<X, Y, A> &&(detail::kLengthOf<A> != 0 || detail::kCommonLength<X, Y, A> == 0)  //
    HS_INLINE auto mix(const X& x, const Y& y, const A& a) {
  return detail::map_numbers([]<class R>(R v, R w, R t) { return v * (R(1) - t) + w * t; }, x, y, a);
}
/// Returns y where a is true and x elsewhere, exact. GLSL 8.3.
template <class X, class Y, class A>
requires detail::kIsMask<detail::ComponentOf<A>> &&(detail::NumberArguments<X, Y> || detail::IntegerArguments<X, Y>)  //
    HS_INLINE auto mix(const X& x, const Y& y, const A& a) {
  using T = detail::AlikeOf<X, Y>;
  return detail::map_each([](auto m, auto v, auto w) { return select(m, detail::cast<T>(w), detail::cast<T>(v)); }, a, x, y);
}
/// Returns 0 where x < edge and 1 elsewhere, exact. GLSL 8.3.
template <class Edge, class X>
requires detail::NumberArguments<X, Edge> HS_INLINE auto step(const Edge& edge, const X& x) {
  return detail::map_numbers([]<class R>(R a, R e) { return select(a < e, R(0), R(1)); }, x, edge);
}
/// Returns t·t·(3 − 2·t) for t = clamp((x − low)/(high − low), 0, 1), with a rounding for every operation. low = high gives 0 or 1, or 0
/// where x is equal to both. GLSL 8.3.
template <class Low, class High, class X>
requires detail::NumberArguments<X, Low, High> HS_INLINE auto smoothstep(const Low& low, const High& high, const X& x) {
  return detail::map_numbers(
      []<class R>(R a, R l, R h) {
        const R t = min(max((a - l) / (h - l), R(0)), R(1));
        return t * t * (R(3) - R(2) * t);
      },
      x, low, high);
}

/// Whether x is NaN, as a mask per component. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto isnan(const X& x) {
  return detail::map_numbers([](auto a) { return a != a; }, x);
}
/// Whether x is infinite, as a mask per component. GLSL 8.3.
template <class X>
requires detail::NumberArguments<X> HS_INLINE auto isinf(const X& x) {
  return detail::map_numbers([]<class R>(R a) { return abs(a) == R(detail::kInfinity); }, x);
}

/// Returns a·b + c, rounded once. GLSL 4.00, 8.3; fma of scalars is in lanes.h.
template <class A, class B, class C>
requires detail::NumberVectors<A, B, C> HS_INLINE auto fma(const A& a, const B& b, const C& c) {
  return detail::map_numbers([](auto x, auto y, auto z) { return fma(x, y, z); }, a, b, c);
}

namespace detail {

/// The significand in [1/2, 1) and the exponent of x. Zero, infinities and NaN have themselves as significand, and the exponent 0.
template <class R>
HS_INLINE MantissaExponent<R> significand_and_exponent(R x) {
  if constexpr (std::is_same_v<R, double>) {
    int32_t exponent = 0;
    const double significand = std::frexp(x, &exponent);
    return {significand, std::isfinite(x) ? exponent : 0};
  } else {
    using I = IntOf<R>;
    const MaskOf<R> subnormal = abs(x) < R(0x1p-126f);
    const I i = as_int(select(subnormal, x * R(0x1p24f), x));
    const I exponent = ((i >> 23) & 255) - select(subnormal, I(126 + 24), I(126));
    const MaskOf<R> has_exponent = x != R(0) && abs(x) < R(kInfinity);
    return {select(has_exponent, as_real((i & (kSignBit | 0x7fffff)) | 0x3f000000), x), select(has_exponent, exponent, I(0))};
  }
}

template <class R>
HS_INLINE R times_power_of_two(R x, IntOf<R> exponent) {
  if constexpr (std::is_same_v<R, double>) {
    return std::ldexp(x, exponent);
  } else {
    const MantissaExponent<R> parts = split(abs(x));
    const IntOf<R> limit = 400, sum = parts.e + min(max(exponent, -limit), limit);
    const R r = with_sign_of(scale(parts.m, min(max(sum, IntOf<R>(-199)), IntOf<R>(199))), x);
    return select(x != R(0) && abs(x) < R(kInfinity), r, x);
  }
}

}  // namespace detail

/// Returns the significand in [1/2, 1) of x and sets the exponent: x = significand·2^exponent. Exact. Zero, infinities and NaN return
/// themselves and set 0. GLSL 4.00, 8.3.
template <class X, class E>
requires detail::NumberArguments<X> HS_INLINE X frexp(const X& x, E& exponent) {
  exponent = detail::map_numbers([](auto a) { return detail::significand_and_exponent(a).e; }, x);
  return detail::map_numbers([](auto a) { return detail::significand_and_exponent(a).m; }, x);
}
/// Returns x·2^exponent, rounded once: exact unless the result is subnormal. GLSL 4.00, 8.3.
template <class X, class E>
requires detail::NumberArguments<X> &&
    (detail::IntegerArguments<E> && (detail::kLengthOf<E> == 0 || detail::kLengthOf<E> == detail::kLengthOf<X>))  //
    HS_INLINE auto ldexp(const X& x, const E& exponent) {
  return detail::map_each([]<class R>(R a, auto e) { return detail::times_power_of_two(a, detail::cast<IntOf<R>>(e)); }, x, exponent);
}

}  // namespace halfspace::HS_LANES
