// SPDX-License-Identifier: Apache-2.0
//
// Decoding of packed texels: 8-bit texels in one 32-bit word, red in the low byte, and half-float texels in two words.
#pragma once

#include "halfspace/core/half.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/srgb.h"
#include "halfspace/core/texel_format.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// The largest rgba32f texel: half of the largest float, so that the difference of two texels cannot overflow.
inline constexpr float kMaxTexel = 0x1.fffffep126f;

namespace detail {

/// Unpacks channels of an 8-bit texel for filtering: all (Value is vec4), or red, green and blue (vec3). sRGB colors become linear values;
/// other channels remain integers, 0 to 255.
template <class Value, TexelFormat format, class R>
HS_INLINE Value decode_rgba8(IntOf<R> texel) {
  const auto color = [&] {
    const IntOf<R> r = texel & 255, g = (texel >> 8) & 255, b = (texel >> 16) & 255;
    if constexpr (format == TexelFormat::srgb8a8)
      return vec3<R>(srgb_to_linear<R>(r), srgb_to_linear<R>(g), srgb_to_linear<R>(b));
    else
      return vec3<R>(to_real<R>(r), to_real<R>(g), to_real<R>(b));
  };
  const auto alpha = [&] { return to_real<R>((texel >> 24) & 255); };
  if constexpr (std::is_same_v<Value, vec3<R>>)
    return color();
  else
    return {color(), alpha()};
}
/// Converts filtered channels to linear values. A single channel is alpha.
template <TexelFormat format, Number R>
HS_INLINE R rgba8_to_linear(R alpha) {
  return unorm8_to_linear(alpha);
}
template <TexelFormat format, class R>
HS_INLINE vec3<R> rgba8_to_linear(const vec3<R>& c) {
  if constexpr (format == TexelFormat::srgb8a8) return c;
  return {unorm8_to_linear(c.x), unorm8_to_linear(c.y), unorm8_to_linear(c.z)};
}
template <TexelFormat format, class R>
HS_INLINE vec4<R> rgba8_to_linear(const vec4<R>& c) {
  return vec4<R>(rgba8_to_linear<format>(vec3<R>(c)), unorm8_to_linear(c.w));
}

/// Returns a + f·(b − a) for 0 <= f <= 1 − 2^-15. The result is always between a and b: rounding increases b − a by at most a
/// relative 2^-24, and f reduces it by more. The value before the final, monotonic rounding is therefore between a and b.
template <class R>
HS_INLINE R lerp(R a, R b, R f) {
  return fma(f, b - a, a);
}
template <class R>
HS_INLINE vec3<R> lerp(const vec3<R>& a, const vec3<R>& b, R f) {
  return {lerp(a.x, b.x, f), lerp(a.y, b.y, f), lerp(a.z, b.z, f)};
}
template <class R>
HS_INLINE vec4<R> lerp(const vec4<R>& a, const vec4<R>& b, R f) {
  return {lerp(a.x, b.x, f), lerp(a.y, b.y, f), lerp(a.z, b.z, f), lerp(a.w, b.w, f)};
}

/// Converts the half float in the low 16 bits of each word.
template <class R>
HS_INLINE R low_half(IntOf<R> word) {
  if constexpr (kIsPair<R>)
    return {low_half<typename R::Half>(word.low), low_half<typename R::Half>(word.high)};
  else if constexpr (kWidthOf<R> == 1)
    return R(half_to_float(static_cast<uint16_t>(word & 0xffff)));
  else
    return half_to_float(word);
}

/// Unpacks a texel of two words with two half floats each, the first in the low bits.
template <class R>
HS_INLINE vec4<R> decode_rgba16f(IntOf<R> first, IntOf<R> second) {
  return {low_half<R>(first), low_half<R>(first >> 16), low_half<R>(second), low_half<R>(second >> 16)};
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
