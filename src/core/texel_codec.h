// SPDX-License-Identifier: Apache-2.0
//
// Conversion between values and the codes of texel formats (OpenGL 4.6, sections 2.3.4 and 2.3.5). R is float, or lanes with one texel
// each; the results are the same. Values are rounded to the nearest code, ties to even.
#pragma once

#include <array>
#include <limits>

#include "halfspace/core/half.h"
#include "halfspace/core/srgb.h"
#include "halfspace/core/texel_format.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// Unsigned normalized codes with 1 to 16 bits: code/(2^bits − 1). The decoded value is the float nearest to the quotient. NaN gives 0.
template <Number R>
HS_INLINE IntOf<R> encode_unorm(R x, int bits) {
  // The ulp of a float is 1 in [2^23, 2^24), so fma rounds the exact product to an integer, once.
  const auto max = static_cast<float>((1 << bits) - 1);
  return as_int(fma(clamp(x, 0.0f, 1.0f), R(max), R(0x1p23f))) & ((1 << bits) - 1);
}
template <Number R>
HS_INLINE R decode_unorm(IntOf<R> code, int bits) {
  return to_real<R>(code) / R(static_cast<float>((1 << bits) - 1));
}

/// Signed normalized codes with 2 to 16 bits: max(code/(2^(bits − 1) − 1), −1), where the code is a signed integer. NaN gives −1.
template <Number R>
HS_INLINE IntOf<R> encode_snorm(R x, int bits) {
  // The ulp of a float is 1 in [2^23, 2^24), also below 1.5·2^23.
  const auto max = static_cast<float>((1 << (bits - 1)) - 1);
  const R bias(0x1.8p23f);
  return as_int(fma(clamp(x, -1.0f, 1.0f), R(max), bias)) - as_int(bias);
}
template <Number R>
HS_INLINE R decode_snorm(IntOf<R> code, int bits) {
  return max(to_real<R>(code) / R(static_cast<float>((1 << (bits - 1)) - 1)), R(-1.0f));
}

/// Unsigned floats with 5 bits of exponent (bias 15) and 5 or 6 bits of mantissa. Negative values give 0, and finite values beyond the
/// largest finite one give that. Infinity stays infinity, and NaN stays NaN, with other bits.
template <Number R>
HS_INLINE IntOf<R> encode_small_float(R x, int mantissa_bits) {
  using I = IntOf<R>;
  const int dropped = 23 - mantissa_bits;
  const R largest(65536.0f - static_cast<float>(32768 >> mantissa_bits));
  const I i = as_int(min(largest, max(R(0.0f), x))) & 0x7fffffff;  // the order of the arguments keeps NaN and −0
  const I normal = (i - 0x38000000 + ((1 << (dropped - 1)) - 1) + ((i >> dropped) & 1)) >> dropped;
  // Values below 2^-14: the ulp of a float in [2^e, 2^(e + 1)) is 2^(e − 23), so the addition rounds to the ulp of these codes.
  const R bias(static_cast<float>(1 << (23 - 14 - mantissa_bits)));
  const I subnormal = as_int(as_real(i) + bias) - as_int(bias);
  const I nan((0x1f << mantissa_bits) | (1 << (mantissa_bits - 1)));
  const I finite = select(i < I(0x38800000), subnormal, normal);
  const I special = select(x == x, I(0x1f << mantissa_bits), nan);
  return select(x < R(std::numeric_limits<float>::infinity()), finite, special);
}
template <Number R>
HS_INLINE R decode_small_float(IntOf<R> code, int mantissa_bits) {
  using I = IntOf<R>;
  const I i = code << (23 - mantissa_bits);
  const I normal = i + 0x38000000;
  const I subnormal = as_int(as_real(i + 0x38800000) - R(0x1p-14f));
  const I special = i + 0x70000000;  // infinity and NaN
  return as_real(select(i >= I(0x0f800000), special, select(i < I(0x00800000), subnormal, normal)));
}

inline constexpr float kMaxD24 = 16777215.0f;
/// Returns the code of a depth in [0, 1], an integer from 0 to 2^24 − 1, as a float. It is rounded once: the sum of 2^23 and a value below
/// 2^23 has no fraction bits, so the fma rounds to an integer, and the product of a depth above 1/2 has none either.
template <Number R>
HS_INLINE R encode_d24(R z) {
  const R two_to_23(0x1p23f), code = z * R(kMaxD24);
  return select(code < two_to_23, fma(z, R(kMaxD24), two_to_23) - two_to_23, code);
}

/// Three mantissas of 9 bits and, in the highest 5 bits, a common exponent (OpenGL 4.6, section 8.5.2). Negative values and NaN give 0, and
/// values beyond 65408 give that.
template <Number R>
HS_INLINE IntOf<R> encode_rgb9_e5(const vec3<R>& color) {
  using I = IntOf<R>;
  const auto in_range = [](R x) { return select(x == x, clamp(x, 0.0f, 65408.0f), R(0.0f)); };
  const R r = in_range(color.x), g = in_range(color.y), b = in_range(color.z);
  // Rounds half up, as the specification does. x is less than 512, so its fraction is exact.
  const auto rounded = [](R x) { return truncate_to_int(x) + select(x - floor(x) >= R(0.5f), I(1), I(0)); };
  const auto scale_for = [](I exponent) { return as_real((I(127 + 24) - exponent) << 23); };
  const R largest = max(r, max(g, b));
  const I preliminary = max((as_int(largest) >> 23) - 127, I(-16)) + 16;
  const I exponent = preliminary + select(rounded(largest * scale_for(preliminary)) == I(512), I(1), I(0));
  const R scale = scale_for(exponent);
  return rounded(r * scale) | rounded(g * scale) << 9 | rounded(b * scale) << 18 | exponent << 27;
}
template <Number R>
HS_INLINE vec3<R> decode_rgb9_e5(IntOf<R> code) {
  const R scale = as_real((((code >> 27) & 31) + (127 - 24)) << 23);
  const auto channel = [&](int shift) { return to_real<R>((code >> shift) & 511) * scale; };
  return {channel(0), channel(9), channel(18)};
}

/// Returns the finite value of a texel of the format that is nearest to a color: what a later read returns. NaN stays NaN, and so do
/// infinities in floats of 32 bits. Only for formats that are not integers. Channels that the format does not have become 0, and alpha 1.
/// Depth formats use the first channel.
template <Number R>
vec4<R> nearest_texel(TexelFormat format, const vec4<R>& color);

/// The same for integer formats: clamps the channels to the integers of the format. Unsigned values are passed as their bits.
template <Number R>
std::array<IntOf<R>, 4> nearest_integers(TexelFormat format, const std::array<IntOf<R>, 4>& values);

/// Decode and encode a texel in memory, which need not be aligned. A texel that is decoded and encoded keeps its bytes, with these
/// exceptions: the second code of −1 of signed normalized formats, unused bits of NaN, rgb9_e5, and depths. Infinities are stored as such;
/// nearest_texel() makes them finite. Depth formats use the first channel, and encoding them sets their stencil to 0.
glm::vec4 decode_texel(TexelFormat format, const std::byte* texel);
void encode_texel(TexelFormat format, const glm::vec4& color, std::byte* texel);

/// The same for integer formats. Unsigned values are passed as their bits.
glm::ivec4 decode_integers(TexelFormat format, const std::byte* texel);
void encode_integers(TexelFormat format, const glm::ivec4& values, std::byte* texel);

}  // namespace halfspace::HS_LANES
