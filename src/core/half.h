// SPDX-License-Identifier: Apache-2.0
//
// Conversion between float and half (IEEE 754 binary16), for scalars and lanes. Uses the F16C instructions if the build has them; otherwise
// bit operations produce identical results (checked by tests/core/half_test.cpp).
//
// Lanes store one half per int, in the low 16 bits. The high 16 bits are 0 in results and ignored in arguments.
#pragma once

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

/// The largest finite half.
inline constexpr float kMaxHalf = 65504.0f;

namespace detail {

/// Converts to half with bit operations. R is float or lanes.
template <class R>
HS_INLINE IntOf<R> float_to_half_by_bits(R x) {
  using I = IntOf<R>;
  const I sign = (as_int(x) >> 16) & 0x8000;
  const I i = as_int(x) & 0x7fffffff;
  // Normal halves (2^-14 and above): rebias the exponent from 127 to 15 and round off 13 mantissa bits, ties to even. Inputs are clamped to
  // 2^16, which becomes infinity. For inputs from 65520, rounding carries into the exponent, which gives infinity as well.
  const I clamped = min(i, I(0x47800000));
  const I normal = (clamped - 0x38000000 + 0xfff + ((clamped >> 13) & 1)) >> 13;
  // Smaller values: the ulp of a float near 0.5 is 2^-24, which is also the ulp of a subnormal half, so the addition rounds.
  const I subnormal = as_int(abs(x) + R(0.5f)) - 0x3f000000;
  const I nan = ((i >> 13) & 0x3ff) | 0x7e00;
  const I finite = select(i < I(0x38800000), subnormal, normal);
  return sign | select(i > I(0x7f800000), nan, finite);
}

/// Converts from half with bit operations. Bits 16 and above are ignored.
template <class R>
HS_INLINE R half_to_float_by_bits(IntOf<R> h) {
  using I = IntOf<R>;
  const I sign = (h & 0x8000) << 16;
  const I i = (h & 0x7fff) << 13;
  const I normal = i + 0x38000000;
  const I subnormal = as_int(as_real(i + 0x38800000) - R(0x1p-14f));
  const I special = i + 0x70000000;
  const I quiet = select(i > I(0x0f800000), I(0x400000), I(0));
  const I finite = select(i < I(0x00800000), subnormal, normal);
  return as_real(sign | select(i >= I(0x0f800000), special | quiet, finite));
}

}  // namespace detail

/// Converts to the nearest half, ties to even. 65520 and above become infinity. NaN becomes quiet and keeps its sign and
/// high mantissa bits.
HS_INLINE uint16_t float_to_half(float x) {
#ifdef __F16C__
  return static_cast<uint16_t>(_mm_extract_epi16(_mm_cvtps_ph(_mm_set_ss(x), _MM_FROUND_TO_NEAREST_INT), 0));
#else
  return static_cast<uint16_t>(detail::float_to_half_by_bits(x));
#endif
}
template <int W>
HS_INLINE IntN<W> float_to_half(RealN<W> x) {
  using V [[maybe_unused]] = typename IntN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) {
    const __m256i h = _mm512_maskz_cvtps_ph(detail::kAll16, (__m512)x.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    return IntN<W>((V)_mm512_maskz_cvtepu16_epi32(detail::kAll16, h));
  }
#endif
#if defined(__F16C__) && defined(__AVX2__)
  if constexpr (W == 8) return IntN<W>((V)_mm256_cvtepu16_epi32(_mm256_cvtps_ph((__m256)x.v, _MM_FROUND_TO_NEAREST_INT)));
  if constexpr (W == 4) return IntN<W>((V)_mm_cvtepu16_epi32(_mm_cvtps_ph((__m128)x.v, _MM_FROUND_TO_NEAREST_INT)));
#endif
  return detail::float_to_half_by_bits(x);
}

/// Converts a half to float. Exact; a signaling NaN becomes quiet.
HS_INLINE float half_to_float(uint16_t h) {
#ifdef __F16C__
  return _mm_cvtss_f32(_mm_cvtph_ps(_mm_cvtsi32_si128(h)));
#else
  return detail::half_to_float_by_bits<float>(h);
#endif
}
template <int W>
HS_INLINE RealN<W> half_to_float(IntN<W> h) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) {
    const __m256i packed = _mm512_maskz_cvtepi32_epi16(detail::kAll16, (__m512i)h.v);
    return RealN<W>((V)_mm512_maskz_cvtph_ps(detail::kAll16, packed));
  }
#endif
#if defined(__F16C__) && defined(__AVX2__)
  const IntN<W> low = h & 0xffff;
  if constexpr (W == 8) {
    const __m256i pairs = _mm256_packus_epi32((__m256i)low.v, (__m256i)low.v);  // within each 128 bits: 0123 0123 4567 4567
    return RealN<W>((V)_mm256_cvtph_ps(_mm256_castsi256_si128(_mm256_permute4x64_epi64(pairs, 0b1000))));
  }
  if constexpr (W == 4) return RealN<W>((V)_mm_cvtph_ps(_mm_packus_epi32((__m128i)low.v, (__m128i)low.v)));
#endif
  return detail::half_to_float_by_bits<RealN<W>>(h);
}

/// Clamps to ±65504, the range of finite halves. NaN stays NaN, because min and max return their second argument for NaN.
template <class R>
HS_INLINE R finite_half_range(R x) {
  return min(R(kMaxHalf), max(R(-kMaxHalf), x));
}

/// Converts to the nearest finite half, for storing colors. Values beyond ±65504, including infinities, become ±65504. NaN
/// stays a quiet NaN.
HS_INLINE uint16_t float_to_finite_half(float x) { return float_to_half(finite_half_range(x)); }
template <int W>
HS_INLINE IntN<W> float_to_finite_half(RealN<W> x) {
  return float_to_half(finite_half_range(x));
}

}  // namespace halfspace::HS_LANES
