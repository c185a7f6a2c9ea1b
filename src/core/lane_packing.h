// SPDX-License-Identifier: Apache-2.0
//
// Moves selected lanes to the front of a vector, and back.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Lane numbers for each mask of eight lanes, one byte per lane. If to_front, byte k is the number of the lane of the k-th set bit.
/// Otherwise, byte i is the number of set bits below bit i. The other bytes are 0. Hidden, because g++ exports templates of
/// variables in spite of -fvisibility=hidden.
template <bool to_front>
[[gnu::visibility("hidden")]] inline constexpr std::array<uint64_t, 256> kPackedLanes = [] {
  std::array<uint64_t, 256> table{};
  for (std::size_t lanes = 0; lanes < table.size(); ++lanes) {
    uint64_t rank = 0;
    for (uint64_t i = 0; i < 8; ++i) {
      if ((lanes >> i & 1) == 0) continue;
      table[lanes] |= to_front ? i << 8 * rank : rank << 8 * i;
      ++rank;
    }
  }
  return table;
}();

#ifdef __AVX2__
template <bool to_front>
HS_INLINE __m256i packed_lanes(uint32_t lanes) {
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(std::bit_cast<int64_t>(kPackedLanes<to_front>[lanes])));
}
#endif

}  // namespace detail

/// Moves the lanes whose bits are set in `lanes` to the front, in order. The remaining lanes are unspecified. lanes < 2^W.
template <int W>
HS_INLINE IntN<W> pack_lanes(IntN<W> v, uint32_t lanes) {
  using V = typename IntN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return IntN<W>((V)_mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), (__m512i)v.v));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) return IntN<W>((V)_mm256_permutevar8x32_epi32((__m256i)v.v, detail::packed_lanes<true>(lanes)));
#endif
  IntN<W> r(0);
  int front = 0;
  for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) set_lane(r, front++, lane(v, std::countr_zero(rest)));
  return r;
}
HS_INLINE int32_t pack_lanes(int32_t v, uint32_t) { return v; }

/// The inverse of pack_lanes: moves lane k to the k-th lane whose bit is set in `lanes`. The remaining lanes are unspecified. lanes < 2^W.
template <int W>
HS_INLINE RealN<W> unpack_lanes(RealN<W> v, uint32_t lanes) {
  using V = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return RealN<W>((V)_mm512_maskz_expand_ps(static_cast<__mmask16>(lanes), (__m512)v.v));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) return RealN<W>((V)_mm256_permutevar8x32_ps((__m256)v.v, detail::packed_lanes<false>(lanes)));
#endif
  RealN<W> r(0.0f);
  int front = 0;
  for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) set_lane(r, std::countr_zero(rest), lane(v, front++));
  return r;
}
HS_INLINE float unpack_lanes(float v, uint32_t) { return v; }

/// Like unpack_lanes, for the bits of a mask: bit k moves to the position of the k-th set bit of `lanes`. The remaining bits are 0.
HS_INLINE uint32_t unpack_bits(uint32_t mask, uint32_t lanes) {
#ifdef __BMI2__
  return _pdep_u32(mask, lanes);
#else
  uint32_t r = 0;
  for (uint32_t rest = lanes; rest != 0; rest &= rest - 1, mask >>= 1) r |= (mask & 1) != 0 ? rest & -rest : 0;
  return r;
#endif
}

}  // namespace halfspace::HS_LANES
