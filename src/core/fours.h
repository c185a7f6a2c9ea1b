// SPDX-License-Identifier: Apache-2.0
//
// Records that lie anywhere, read by lanes: four neighbouring words of each, and then turned word by word. About a third of what four
// gathers cost, for a record's words come together.
#pragma once

#include <array>

#include "core/lanes.h"

namespace halfspace {

namespace detail {

template <class T>
HS_INLINE T load_at(const void* p) {
  return load<T>(static_cast<const std::byte*>(p));
}

#ifdef __AVX512F__
template <class Place>
HS_INLINE std::array<IntN<16>, 4> load_fours_of_16(const Place& place) {
  const auto part = [&](int k) {  // records k, 4 + k, 8 + k, 12 + k
    const __m512 one = _mm512_zextps128_ps512(load_at<__m128>(place(k)));
    const __m512 two = _mm512_maskz_insertf32x4(kAll16, one, load_at<__m128>(place(k + 4)), 1);
    const __m512 three = _mm512_maskz_insertf32x4(kAll16, two, load_at<__m128>(place(k + 8)), 2);
    return _mm512_maskz_insertf32x4(kAll16, three, load_at<__m128>(place(k + 12)), 3);
  };
  const __m512 a = part(0), b = part(1), c = part(2), d = part(3);
  const auto pairs = [](__m512 x) { return _mm512_castps_pd(x); };
  const __m512d low_ab = pairs(_mm512_maskz_unpacklo_ps(kAll16, a, b)), high_ab = pairs(_mm512_maskz_unpackhi_ps(kAll16, a, b));
  const __m512d low_cd = pairs(_mm512_maskz_unpacklo_ps(kAll16, c, d)), high_cd = pairs(_mm512_maskz_unpackhi_ps(kAll16, c, d));
  constexpr __mmask8 all8 = 0xff;
  const auto word = [](__m512d x) { return IntN<16>((IntN<16>::V)x); };
  return {word(_mm512_maskz_unpacklo_pd(all8, low_ab, low_cd)), word(_mm512_maskz_unpackhi_pd(all8, low_ab, low_cd)),
          word(_mm512_maskz_unpacklo_pd(all8, high_ab, high_cd)), word(_mm512_maskz_unpackhi_pd(all8, high_ab, high_cd))};
}
#endif

#ifdef __AVX__
template <class Place>
HS_INLINE std::array<IntN<8>, 4> load_fours_of_8(const Place& place) {
  const auto part = [&](int k) {  // records k, 4 + k
    return _mm256_insertf128_ps(_mm256_castps128_ps256(load_at<__m128>(place(k))), load_at<__m128>(place(k + 4)), 1);
  };
  const __m256 a = part(0), b = part(1), c = part(2), d = part(3);
  const auto pairs = [](__m256 x) { return _mm256_castps_pd(x); };
  const __m256d low_ab = pairs(_mm256_unpacklo_ps(a, b)), high_ab = pairs(_mm256_unpackhi_ps(a, b));
  const __m256d low_cd = pairs(_mm256_unpacklo_ps(c, d)), high_cd = pairs(_mm256_unpackhi_ps(c, d));
  const auto word = [](__m256d x) { return IntN<8>((IntN<8>::V)x); };
  return {word(_mm256_unpacklo_pd(low_ab, low_cd)), word(_mm256_unpackhi_pd(low_ab, low_cd)), word(_mm256_unpacklo_pd(high_ab, high_cd)),
          word(_mm256_unpackhi_pd(high_ab, high_cd))};
}
#endif

}  // namespace detail

/// Four neighbouring 32-bit words of each lane's record: lane k of element i holds word i from place(k) on, a pointer to anything. All 16
/// bytes must be readable. I: IntN<W> or int32_t.
template <class I, class Place>
HS_INLINE std::array<I, 4> load_fours(const Place& place) {
  constexpr int width = static_cast<int>(sizeof(I) / sizeof(int32_t));
#ifdef __AVX512F__
  if constexpr (width == 16) return detail::load_fours_of_16(place);
#endif
#ifdef __AVX__
  if constexpr (width == 8) return detail::load_fours_of_8(place);
#endif
  std::array<I, 4> words{};
  for (int k = 0; k < width; ++k) {
    const auto record = detail::load_at<std::array<int32_t, 4>>(place(k));
    for (std::size_t i = 0; i < 4; ++i) set_lane(words[i], k, record[i]);
  }
  return words;
}

}  // namespace halfspace
