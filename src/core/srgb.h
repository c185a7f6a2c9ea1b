// SPDX-License-Identifier: Apache-2.0
//
// Conversion between 8-bit values and linear values, for the sRGB transfer function (IEC 61966-2-1) and for unsigned normalized integers.
// 16-bit unsigned normalized integers can only be decoded. Results are correctly rounded and bit-identical at every width. Nothing here
// computes a power: decoding uses a table of 256 floats, encoding a table of thresholds. Both tables are computed at compile time using
// only + − × ÷ (srgb.cpp).
//
//   decode(v) = v/12.92 for v <= 0.04045, else ((v + 0.055)/1.055)^2.4        encode is its inverse
#pragma once

#include <array>

#include "halfspace/core/lane_pairs.h"

namespace halfspace::HS_LANES {

namespace detail {

// The encoder divides [2^-13, 1) into buckets of equal exponent and equal leading 7 mantissa bits. Encoded values change slowly enough that
// a bucket has at most one threshold (asserted in srgb.cpp). The entry of a bucket, in 16.16 fixed point, is its first encoded value plus
// an offset. At and above the threshold, this offset makes the low 16 bits of a float carry into the encoded value.
inline constexpr int32_t kSrgbFirstBits = 0x39000000;  // 2^-13; everything below encodes to 0
inline constexpr int kSrgbBuckets = 13 * 128;
extern const std::array<int32_t, kSrgbBuckets> kSrgbEncode;

}  // namespace detail

/// kSrgbToLinear[c] is the float nearest to decode(c/255).
alignas(64) extern const std::array<float, 256> kSrgbToLinear;

namespace detail {

/// Pairs of floats that make up a decoded texel: (red, 0, blue, 0) + (0, green, 0, alpha).
struct SrgbPairs {
  using Table = std::array<std::array<float, 2>, 256>;
  Table first, second;  ///< entry c is {kSrgbToLinear[c], 0}, or {0, kSrgbToLinear[c]}
  Table alpha;          ///< entry c is {0, c}
};
alignas(64) extern const SrgbPairs kSrgbPairs;

}  // namespace detail

#ifdef __AVX512F__
namespace detail {

/// Returns table[code] for `code` in 0 … 255, by permuting the table in 16 registers; takes a third of the time of a gather. Five bits of
/// the code select within two registers, and the other three select the pair.
HS_INLINE RealN<16> permute_256(const float* table, IntN<16> code) {
  const __m512i c = (__m512i)code.v;
  const auto pair = [&](int i) { return _mm512_permutex2var_ps(_mm512_load_ps(table + 32 * i), c, _mm512_load_ps(table + 32 * i + 16)); };
  const __mmask16 bit5 = _mm512_test_epi32_mask(c, _mm512_set1_epi32(32));
  const __mmask16 bit6 = _mm512_test_epi32_mask(c, _mm512_set1_epi32(64));
  const __mmask16 bit7 = _mm512_test_epi32_mask(c, _mm512_set1_epi32(128));
  const auto four = [&](int i) { return _mm512_mask_blend_ps(bit5, pair(i), pair(i + 1)); };
  const auto eight = [&](int i) { return _mm512_mask_blend_ps(bit6, four(i), four(i + 2)); };
  return RealN<16>((typename RealN<16>::V)_mm512_mask_blend_ps(bit7, eight(0), eight(4)));
}

}  // namespace detail
#endif

/// Returns the linear value of each 8-bit sRGB value, correctly rounded. Every lane of code must be in 0 … 255.
template <Number R>
HS_INLINE R srgb_to_linear(IntOf<R> code) {
  if constexpr (kIsPair<R>) {
    return {srgb_to_linear<typename R::Half>(code.low), srgb_to_linear<typename R::Half>(code.high)};
  } else {
#ifdef __AVX512F__
    if constexpr (std::is_same_v<R, RealN<16>>) return detail::permute_256(kSrgbToLinear.data(), code);
#endif
    return R(gather(kSrgbToLinear.data(), code));
  }
}

/// Returns the 8-bit sRGB value, 0 … 255, nearest to 255·encode(x), for every float x. x < 0 and NaN give 0; x > 1 gives 255. A double is
/// first rounded to float.
template <Number R>
HS_INLINE IntOf<R> linear_to_srgb(R x) {
  if constexpr (std::is_same_v<R, double>)
    return linear_to_srgb(static_cast<float>(x));
  else {
    const IntOf<R> i = as_int(clamp(x, 0x1p-13f, 0x1.fffffep-1f)) - IntOf<R>(detail::kSrgbFirstBits);
    return (gather(detail::kSrgbEncode.data(), i >> 16) + (i & 0xffff)) >> 16;
  }
}

/// Returns code/255 for `code` in [0, 255], rounded to the nearest float if `code` is an integer. Filtered values, which are fractional,
/// are allowed too. The function is monotonic, and 255 gives 1.
template <Number R>
HS_INLINE R unorm8_to_linear(R code) {
  if constexpr (std::is_same_v<R, double>)
    return code / 255.0;
  else {
    constexpr float kHigh = 1.0f / 255.0f;
    constexpr float kLow = static_cast<float>(1.0 / 255.0 - static_cast<double>(kHigh));
    return fma(code, R(kHigh), code * R(kLow));
  }
}

/// Returns code/65535 for `code` in [0, 65535], with the same properties as unorm8_to_linear.
template <Number R>
HS_INLINE R unorm16_to_linear(R code) {
  if constexpr (std::is_same_v<R, double>)
    return code / 65535.0;
  else {
    constexpr float kHigh = 1.0f / 65535.0f;
    constexpr float kLow = static_cast<float>(1.0 / 65535.0 - static_cast<double>(kHigh));
    return fma(code, R(kHigh), code * R(kLow));
  }
}

/// Returns the integer 0 … 255 nearest to 255·x, for every float x. x < 0 and NaN give 0; x > 1 gives 255. No float lies halfway between
/// two results.
template <Number R>
HS_INLINE IntOf<R> linear_to_unorm8(R x) {
  if constexpr (std::is_same_v<R, double>)
    return round_to_int(clamp(x, 0.0, 1.0) * 255.0);
  else {
    // The ulp of a float is 1 in [2^23, 2^24), so fma rounds the exact product to an integer, once.
    return as_int(fma(clamp(x, 0.0f, 1.0f), R(255.0f), R(0x1p23f))) & 0xff;
  }
}

}  // namespace halfspace::HS_LANES
