// SPDX-License-Identifier: Apache-2.0
//
// Texel formats, and decoding of 8-bit texels, which are packed into a 32-bit word with red in the low byte.
#pragma once

#include "halfspace/core/lanes.h"
#include "halfspace/core/srgb.h"
#include "halfspace/core/vec.h"

namespace halfspace {

/// Storage formats of texels. Formats with one channel read as (r, 0, 0, 1).
enum class TexelFormat : uint8_t {
  rgba8,    ///< value = code/255
  srgb8a8,  ///< sRGB-encoded red, green and blue; linear alpha, code/255
  r8,       ///< value = code/255
  r16,      ///< value = code/65535
  rgba16f,  ///< linear halfs, always finite: values are clamped to ±65504, NaN becomes 0
  rgba32f   ///< linear floats, clamped to ±kMaxTexel; NaN becomes 0
};

namespace detail {

/// Unpacks channels of an 8-bit texel for filtering: all (Value = vec4), red, green and blue (vec3), or alpha (R). sRGB colors become
/// linear values; other channels remain codes, 0 to 255.
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
  else if constexpr (std::is_same_v<Value, R>)
    return alpha();
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

/// Channel k of a packed 8-bit texel plus an offset. Masking the channel and combining it with the exponent bits of the offset gives a
/// float without a conversion instruction.
template <class R>
struct OffsetCode {
  R value, offset;
};
template <class R>
HS_INLINE OffsetCode<R> offset_code(IntOf<R> texel, int k) {
  if (k == 0) return {as_real((texel & 0xff) | 0x4b000000), R(0x1p23f)};
  return {as_real(((texel >> (8 * (k - 1))) & 0xff00) | 0x47000000), R(0x1p15f)};
}

/// Two adjacent texels of a row.
template <class I>
struct TexelPair {
  I left, right;
};

/// Bilinearly filters 2x2 packed 8-bit texels. Value selects the channels: vec4, vec3 (no alpha) or R (only alpha), in the units of
/// decode_rgba8. along is the weight of the right texels, and across is the weight of the upper ones.
template <class Value, TexelFormat format, class R>
HS_INLINE Value mixed_rgba8(const TexelPair<IntOf<R>>& lower, const TexelPair<IntOf<R>>& upper, R along, R across) {
  if constexpr (std::is_same_v<R, double> || (format == TexelFormat::srgb8a8 && !std::is_same_v<Value, R>)) {
    const auto row = [&](const TexelPair<IntOf<R>>& of) {
      return lerp(decode_rgba8<Value, format, R>(of.left), decode_rgba8<Value, format, R>(of.right), along);
    };
    return lerp(row(lower), row(upper), across);
  } else {
    const auto mixed = [&](int k) {
      const auto row = [&](const TexelPair<IntOf<R>>& of) {
        const OffsetCode<R> left = offset_code<R>(of.left, k), right = offset_code<R>(of.right, k);
        return fma(along, right.value - left.value, left.value - left.offset);  // both differences are exact
      };
      return lerp(row(lower), row(upper), across);
    };
    if constexpr (std::is_same_v<Value, R>) {
      return mixed(3);
    } else {
      Value mean;
      for (int k = 0; k < (std::is_same_v<Value, vec3<R>> ? 3 : 4); ++k) mean[k] = mixed(k);
      return mean;
    }
  }
}

}  // namespace detail

}  // namespace halfspace
