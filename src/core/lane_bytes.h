// SPDX-License-Identifier: Apache-2.0
//
// Loads and stores one byte per lane, and computes with the four bytes of each lane. GCC 12 compiles __builtin_convertvector between bytes
// and integers to one instruction per lane.
#pragma once

#include <bit>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

/// Loads one byte per lane, from 0 to 255. p need not be aligned.
template <class I>
HS_INLINE I load_u8(const uint8_t* p) {
#ifdef __AVX512F__
  if constexpr (std::is_same_v<I, IntN<16>>) {
    return I((typename I::V)_mm512_maskz_cvtepu8_epi32(detail::kAll16, load<__m128i>(p)));
  }
#endif
#ifdef __AVX2__
  if constexpr (std::is_same_v<I, IntN<8>>) return I((typename I::V)_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(load<int64_t>(p))));
#endif
  if constexpr (std::is_same_v<I, int32_t>) {
    return *p;
  } else {
    return I(__builtin_convertvector(load<typename detail::Vectors<sizeof(I) / sizeof(int32_t)>::B>(p), typename I::V));
  }
}

/// Stores the low byte of each lane.
HS_INLINE void store_u8(uint8_t* p, int32_t i) { *p = static_cast<uint8_t>(i); }
template <int W>
HS_INLINE void store_u8(uint8_t* p, IntN<W> i) {
#ifdef __AVX512F__
  if constexpr (W == 16) return store(p, _mm512_maskz_cvtepi32_epi8(detail::kAll16, (__m512i)i.v));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) {
    const __m256i low = _mm256_and_si256((__m256i)i.v, _mm256_set1_epi32(255));
    const __m128i shorts = _mm_packus_epi32(_mm256_castsi256_si128(low), _mm256_extracti128_si256(low, 1));
    return store(p, _mm_cvtsi128_si64(_mm_packus_epi16(shorts, shorts)));
  }
#endif
  store(p, __builtin_convertvector(i.v, typename detail::Vectors<W>::B));
}

namespace detail {
using LaneBytes = uint8_t __attribute__((vector_size(4 * kLanes)));
HS_INLINE LaneBytes bytes_of(Int i) { return std::bit_cast<LaneBytes>(i); }
}  // namespace detail

/// min_bytes() and max_bytes() return the smaller and the larger of each pair of unsigned bytes.
HS_INLINE Int min_bytes(Int a, Int b) {
  const detail::LaneBytes x = detail::bytes_of(a), y = detail::bytes_of(b);
  return std::bit_cast<Int>(x < y ? x : y);
}
HS_INLINE Int max_bytes(Int a, Int b) {
  const detail::LaneBytes x = detail::bytes_of(a), y = detail::bytes_of(b);
  return std::bit_cast<Int>(x > y ? x : y);
}
/// Adds unsigned bytes; sums above 255 become 255.
HS_INLINE Int add_bytes(Int a, Int b) { return std::bit_cast<Int>(detail::bytes_of(a) + detail::bytes_of(min_bytes(b, ~a))); }
/// Subtracts unsigned bytes of b from those of a; differences below 0 become 0.
HS_INLINE Int subtract_bytes(Int a, Int b) { return std::bit_cast<Int>(detail::bytes_of(a) - detail::bytes_of(min_bytes(a, b))); }

}  // namespace halfspace::HS_LANES
