// SPDX-License-Identifier: Apache-2.0
//
// Conversion between records in memory (AoS) and lanes (SoA). For scattered records, four consecutive words of each record are
// loaded at once and transposed in registers, where gathers would fetch every word separately. There are variants for records
// given by an index and for consecutive records of three words.
#pragma once

#include <array>
#include <utility>

#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace detail {

template <class T>
HS_INLINE T load_at(const void* p) {
  return load<T>(static_cast<const std::byte*>(p));
}

template <class T>
HS_INLINE void store_at(void* p, const T& value) {
  store(static_cast<std::byte*>(p), value);
}

#ifdef __AVX512F__
/// Transposes the 4x4 matrix in each 128-bit quarter.
HS_INLINE std::array<IntN<16>, 4> transposed_4x4(const std::array<IntN<16>, 4>& of) {
  const auto row = [&](std::size_t i) { return (__m512)of[i].v; };
  const auto pairs = [](__m512 x) { return _mm512_castps_pd(x); };
  const __m512d low_ab = pairs(_mm512_maskz_unpacklo_ps(kAll16, row(0), row(1)));
  const __m512d high_ab = pairs(_mm512_maskz_unpackhi_ps(kAll16, row(0), row(1)));
  const __m512d low_cd = pairs(_mm512_maskz_unpacklo_ps(kAll16, row(2), row(3)));
  const __m512d high_cd = pairs(_mm512_maskz_unpackhi_ps(kAll16, row(2), row(3)));
  constexpr __mmask8 all8 = 0xff;
  const auto word = [](__m512d x) { return IntN<16>((IntN<16>::V)x); };
  return {word(_mm512_maskz_unpacklo_pd(all8, low_ab, low_cd)), word(_mm512_maskz_unpackhi_pd(all8, low_ab, low_cd)),
          word(_mm512_maskz_unpacklo_pd(all8, high_ab, high_cd)), word(_mm512_maskz_unpackhi_pd(all8, high_ab, high_cd))};
}
/// Loads the records k, k + 4, k + 8 and k + 12 into the four quarters.
template <class Place>
HS_INLINE IntN<16> load_quarters(IntN<16>, const Place& place, int k) {
  const __m512 one = _mm512_zextps128_ps512(load_at<__m128>(place(k)));
  const __m512 two = _mm512_maskz_insertf32x4(kAll16, one, load_at<__m128>(place(k + 4)), 1);
  const __m512 three = _mm512_maskz_insertf32x4(kAll16, two, load_at<__m128>(place(k + 8)), 2);
  return IntN<16>((IntN<16>::V)_mm512_maskz_insertf32x4(kAll16, three, load_at<__m128>(place(k + 12)), 3));
}
template <class Place>
HS_INLINE void store_quarters(IntN<16> records, const Place& place, int k) {
  const auto all = (__m512)records.v;
  store_at(place(k), _mm512_maskz_extractf32x4_ps(0xf, all, 0));
  store_at(place(k + 4), _mm512_maskz_extractf32x4_ps(0xf, all, 1));
  store_at(place(k + 8), _mm512_maskz_extractf32x4_ps(0xf, all, 2));
  store_at(place(k + 12), _mm512_maskz_extractf32x4_ps(0xf, all, 3));
}
#endif

#ifdef __AVX__
/// The same for two 128-bit halves.
HS_INLINE std::array<IntN<8>, 4> transposed_4x4(const std::array<IntN<8>, 4>& of) {
  const auto row = [&](std::size_t i) { return (__m256)of[i].v; };
  const auto pairs = [](__m256 x) { return _mm256_castps_pd(x); };
  const __m256d low_ab = pairs(_mm256_unpacklo_ps(row(0), row(1))), high_ab = pairs(_mm256_unpackhi_ps(row(0), row(1)));
  const __m256d low_cd = pairs(_mm256_unpacklo_ps(row(2), row(3))), high_cd = pairs(_mm256_unpackhi_ps(row(2), row(3)));
  const auto word = [](__m256d x) { return IntN<8>((IntN<8>::V)x); };
  return {word(_mm256_unpacklo_pd(low_ab, low_cd)), word(_mm256_unpackhi_pd(low_ab, low_cd)), word(_mm256_unpacklo_pd(high_ab, high_cd)),
          word(_mm256_unpackhi_pd(high_ab, high_cd))};
}
template <class Place>
HS_INLINE IntN<8> load_quarters(IntN<8>, const Place& place, int k) {
  return IntN<8>((IntN<8>::V)_mm256_insertf128_ps(_mm256_castps128_ps256(load_at<__m128>(place(k))), load_at<__m128>(place(k + 4)), 1));
}
template <class Place>
HS_INLINE void store_quarters(IntN<8> records, const Place& place, int k) {
  store_at(place(k), _mm256_castps256_ps128((__m256)records.v));
  store_at(place(k + 4), _mm256_extractf128_ps((__m256)records.v, 1));
}
#endif

/// Whether lanes of type I can be transposed in registers in this build.
template <class I>
inline constexpr bool kTransposes4x4 = requires(std::array<I, 4> words) {
  transposed_4x4(words);
};

}  // namespace detail

/// Loads four consecutive 32-bit words of the record of each lane. place(k) returns a pointer of any type to the record of lane
/// k; all 16 bytes must be readable. Lane k of element i of the result is word i of that record. I is IntN<W> or int32_t.
template <class I, class Place>
HS_INLINE std::array<I, 4> load_aos4(const Place& place) {
  using namespace detail;  // unqualified calls, because these functions are not declared without AVX
  if constexpr (kTransposes4x4<I>) {
    const auto part = [&](int k) { return load_quarters(I{}, place, k); };
    return transposed_4x4(std::array<I, 4>{part(0), part(1), part(2), part(3)});
  } else {
    std::array<I, 4> words{};
    for (int k = 0; k < static_cast<int>(sizeof(I) / sizeof(int32_t)); ++k) {
      const auto record = detail::load_at<std::array<int32_t, 4>>(place(k));
      for (std::size_t i = 0; i < 4; ++i) set_lane(words[i], k, record[i]);
    }
    return words;
  }
}

/// Stores lane k of the four words to the 16 bytes at place(k); the inverse of load_aos4. The order of the stores is unspecified, so two
/// lanes may share a place only if it does not matter which of them is stored last.
template <class I, class Place>
HS_INLINE void store_aos4(const std::array<I, 4>& words, const Place& place) {
  using namespace detail;
  if constexpr (kTransposes4x4<I>) {
    const std::array<I, 4> records = transposed_4x4(words);
    for (int k = 0; k < 4; ++k) store_quarters(records[static_cast<std::size_t>(k)], place, k);
  } else {
    for (int k = 0; k < static_cast<int>(sizeof(I) / sizeof(int32_t)); ++k) {
      detail::store_at(place(k), std::array<int32_t, 4>{lane(words[0], k), lane(words[1], k), lane(words[2], k), lane(words[3], k)});
    }
  }
}

namespace detail {

/// Returns word I of each of W three-word records that are stored consecutively in a, b and c. (A shuffle numbers the lanes of its
/// second operand starting at W.)
template <std::size_t I, class V, std::size_t... K>
HS_INLINE V third(V a, V b, V c, std::index_sequence<K...>) {
  constexpr std::size_t w = sizeof...(K);
  const auto from_ab = __builtin_shufflevector(a, b, (3 * K + I < 2 * w ? 3 * K + I : 0)...);
  return __builtin_shufflevector(from_ab, c, (3 * K + I < 2 * w ? K : 3 * K + I - w)...);
}

}  // namespace detail

/// Loads consecutive three-word records, 3W words starting at p. Lane k of element i is word 3k + i.
template <class I>
HS_INLINE std::array<I, 3> load_aos3(const int32_t* p) {
  constexpr std::size_t w = sizeof(I) / sizeof(int32_t);
  if constexpr (w == 1) {
    return {p[0], p[1], p[2]};
  } else {
    const auto a = load<I>(p).v, b = load<I>(p + w).v, c = load<I>(p + 2 * w).v;
    constexpr std::make_index_sequence<w> lanes;
    return {I(detail::third<0>(a, b, c, lanes)), I(detail::third<1>(a, b, c, lanes)), I(detail::third<2>(a, b, c, lanes))};
  }
}

/// How many words gather_row may read past the last requested one: for N = 2 it reads four words.
inline constexpr std::size_t kRowSlack = 2;

/// The indices in the lanes of i, as scalars. They must not be negative. Each operation extracts two of them from the register.
template <int W>
class ScalarIndices {
 public:
  HS_INLINE explicit ScalarIndices(IntN<W> i) { store(pairs_.data(), i); }
  HS_INLINE std::size_t operator[](int lane) const {
    const uint64_t pair = pairs_[static_cast<std::size_t>(lane / 2)];
    return lane % 2 == 0 ? static_cast<uint32_t>(pair) : pair >> 32;
  }

 private:
  std::array<uint64_t, W / 2> pairs_;
};

/// Loads base[i], …, base[i + N − 1] lane by lane, for N up to 4. For N > 1 this is faster than N gathers, but four words starting
/// at base[i] must be readable for every lane, even if its result is not used, and no index may be negative.
template <int N, class Word, class I>
HS_INLINE auto gather_row(const Word* base, I i) {
  std::array<decltype(gather(base, i)), N> row;
  if constexpr (N > 1 && detail::kTransposes4x4<I>) {
    const ScalarIndices at(i);
    const auto words = load_aos4<I>([&](int k) { return base + at[k]; });
    for (std::size_t n = 0; n < N; ++n) {
      if constexpr (std::is_same_v<Word, float>) {
        row[n] = as_real(words[n]);
      } else {
        row[n] = words[n];
      }
    }
  } else {
    for (std::size_t n = 0; n < N; ++n) row[n] = gather(base + n, i);
  }
  return row;
}

}  // namespace halfspace::HS_LANES
