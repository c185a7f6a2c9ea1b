// SPDX-License-Identifier: Apache-2.0
//
// Reinterpreting the bits of floats (GLSL 3.30, section 8.3) and packing several numbers into an unsigned integer (GLSL 4.20, section 8.4).
// The first component is in the lowest bits. There are no versions for double.
#pragma once

#include "halfspace/core/discrete_vec.h"
#include "halfspace/core/half.h"

namespace halfspace::HS_LANES {

namespace detail {

template <class R>
concept SinglePrecision = Number<R> && !std::same_as<R, double>;
template <class X>
concept SinglePrecisionNumbers = NumberArguments<X> && SinglePrecision<ComponentOf<X>>;

/// Returns x as an integer with `bits` bits in the low bits of the result: x·scale, rounded to nearest, ties to even.
template <int bits, class R>
HS_INLINE UintOf<R> to_code(R x, float low, float scale) {
  const IntOf<R> code = round_to_int(clamp(x, low, 1.0f) * R(scale));
  return UintOf<R>(code & ((1 << bits) - 1));
}
template <int bits, int L, class R>
HS_INLINE UintOf<R> pack_codes(const VecN<L, R>& v, float low, float scale) {
  UintOf<R> u = to_code<bits>(v.x, low, scale);
  for (int i = 1; i < L; ++i) u |= to_code<bits>(v[i], low, scale) << (bits * i);
  return u;
}
/// Returns code i of u, without or with its sign, as a number.
template <int bits, class R>
HS_INLINE R unsigned_code(const UintOf<R>& u, int i) {
  return to_real<R>(IntOf<R>((u >> (bits * i)) & UintOf<R>((1u << bits) - 1u)));
}
template <int bits, class R>
HS_INLINE R signed_code(const UintOf<R>& u, int i) {
  return to_real<R>(IntOf<R>(u << (32 - bits - bits * i)) >> (32 - bits));
}

template <class R>
HS_INLINE IntOf<R> half_bits(R x) {
  if constexpr (kIsPair<R>) {
    return {half_bits(x.low), half_bits(x.high)};
  } else {
    return float_to_half(x);
  }
}
template <class R>
HS_INLINE R real_of_half(const IntOf<R>& bits) {
  if constexpr (kIsPair<R>) {
    using H = typename R::Half;
    return {real_of_half<H>(bits.low), real_of_half<H>(bits.high)};
  } else if constexpr (std::same_as<R, float>) {
    return half_to_float(static_cast<uint16_t>(bits));
  } else {
    return half_to_float(bits);
  }
}

/// The number type that has the unsigned integer U.
template <class U>
struct RealOfT : std::type_identity<float> {};
template <int W>
struct RealOfT<UintLanes<IntN<W>>> : std::type_identity<RealN<W>> {};
template <class H>
struct RealOfT<UintLanes<IntPair<H>>> : std::type_identity<RealPair<H>> {};
template <class T>
using RealOf = typename RealOfT<UnsignedOf<T>>::type;
template <class U>
concept Unsigned = Integer<U> && kIsUint<U>;

}  // namespace detail

/// The bits of a float as a signed integer, exact. GLSL 8.3.
template <detail::SinglePrecisionNumbers X>
HS_INLINE auto floatBitsToInt(const X& x) {
  return detail::map_numbers([](auto a) { return as_int(a); }, x);
}
/// The bits of a float as an unsigned integer, exact. GLSL 8.3.
template <detail::SinglePrecisionNumbers X>
HS_INLINE auto floatBitsToUint(const X& x) {
  return detail::map_numbers([]<class R>(R a) { return UintOf<R>(as_int(a)); }, x);
}
/// The float with the bits of a signed integer, exact. GLSL 8.3.
template <class X>
requires detail::IntegerArguments<X> && detail::kIsInt<detail::ComponentOf<X>> HS_INLINE auto intBitsToFloat(const X& x) {
  return detail::map_integers([](auto i) { return as_real(i); }, x);
}
/// The float with the bits of an unsigned integer, exact. GLSL 8.3.
template <class X>
requires detail::IntegerArguments<X> && detail::kIsUint<detail::ComponentOf<X>> HS_INLINE auto uintBitsToFloat(const X& x) {
  return detail::map_integers([]<class U>(U u) { return as_real(SignedOf<U>(u)); }, x);
}

/// Packs numbers of [0, 1] with 16 bits each: round(clamp(v, 0, 1)·65535), ties to even after the product is rounded. NaN gives 0.
/// GLSL 8.4.
template <detail::SinglePrecision R>
HS_INLINE UintOf<R> packUnorm2x16(const vec2<R>& v) {
  return detail::pack_codes<16>(v, 0.0f, 65535.0f);
}
/// Packs numbers of [−1, 1] with 16 bits each: round(clamp(v, −1, 1)·32767), ties to even after the product is rounded. NaN gives −1.
/// GLSL 8.4.
template <detail::SinglePrecision R>
HS_INLINE UintOf<R> packSnorm2x16(const vec2<R>& v) {
  return detail::pack_codes<16>(v, -1.0f, 32767.0f);
}
/// Packs numbers of [0, 1] with 8 bits each: round(clamp(v, 0, 1)·255), ties to even after the product is rounded. NaN gives 0. GLSL 8.4.
template <detail::SinglePrecision R>
HS_INLINE UintOf<R> packUnorm4x8(const vec4<R>& v) {
  return detail::pack_codes<8>(v, 0.0f, 255.0f);
}
/// Packs numbers of [−1, 1] with 8 bits each: round(clamp(v, −1, 1)·127), ties to even after the product is rounded. NaN gives −1.
/// GLSL 8.4.
template <detail::SinglePrecision R>
HS_INLINE UintOf<R> packSnorm4x8(const vec4<R>& v) {
  return detail::pack_codes<8>(v, -1.0f, 127.0f);
}

/// Returns code/65535 of both halves, correctly rounded. GLSL 8.4.
template <detail::Unsigned U>
HS_INLINE auto unpackUnorm2x16(const U& u) {
  using R = detail::RealOf<U>;
  return vec2<R>(detail::unsigned_code<16, R>(u, 0), detail::unsigned_code<16, R>(u, 1)) / R(65535.0f);
}
/// Returns max(code/32767, −1) of both halves, correctly rounded. GLSL 8.4.
template <detail::Unsigned U>
HS_INLINE auto unpackSnorm2x16(const U& u) {
  using R = detail::RealOf<U>;
  const vec2<R> codes(detail::signed_code<16, R>(u, 0), detail::signed_code<16, R>(u, 1));
  return detail::map_as<R>([](R a) { return max(a / R(32767.0f), R(-1.0f)); }, codes);
}
/// Returns code/255 of the four bytes, correctly rounded. GLSL 8.4.
template <detail::Unsigned U>
HS_INLINE auto unpackUnorm4x8(const U& u) {
  using R = detail::RealOf<U>;
  return vec4<R>(detail::unsigned_code<8, R>(u, 0), detail::unsigned_code<8, R>(u, 1), detail::unsigned_code<8, R>(u, 2),
                 detail::unsigned_code<8, R>(u, 3)) /
         R(255.0f);
}
/// Returns max(code/127, −1) of the four bytes, correctly rounded. GLSL 8.4.
template <detail::Unsigned U>
HS_INLINE auto unpackSnorm4x8(const U& u) {
  using R = detail::RealOf<U>;
  const vec4<R> codes(detail::signed_code<8, R>(u, 0), detail::signed_code<8, R>(u, 1), detail::signed_code<8, R>(u, 2),
                      detail::signed_code<8, R>(u, 3));
  return detail::map_as<R>([](R a) { return max(a / R(127.0f), R(-1.0f)); }, codes);
}

/// Packs both components as halves, rounded to nearest, ties to even. GLSL 8.4.
template <detail::SinglePrecision R>
HS_INLINE UintOf<R> packHalf2x16(const vec2<R>& v) {
  return UintOf<R>(detail::half_bits(v.x)) | (UintOf<R>(detail::half_bits(v.y)) << 16);
}
/// Returns the two halves in u as floats, exact. GLSL 8.4.
template <detail::Unsigned U>
HS_INLINE auto unpackHalf2x16(const U& u) {
  using R = detail::RealOf<U>;
  return vec2<R>(detail::real_of_half<R>(IntOf<R>(u & U(0xffffu))), detail::real_of_half<R>(IntOf<R>(u >> 16)));
}

}  // namespace halfspace::HS_LANES
