// SPDX-License-Identifier: Apache-2.0
//
// Bilinear filtering of 2x2 texels, for formats with four channels.
//
// Where the build has the instructions, textures are filtered texel by texel, with all four channels in one register, and the result is
// transposed. Otherwise, and for srgb8a8 with 16 lanes, each channel is filtered for all lanes. Both methods give bit-identical results:
// the sum along a row of rgba8 is an integer below 2^23, which is exact, and everything else is computed with the same operations.
#pragma once

#include "halfspace/core/half.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/transpose.h"
#include "halfspace/shading/texture/packed_texels.h"

namespace halfspace::HS_LANES::detail {

inline constexpr int kFractionBits = 15;  ///< of texel weights; Texture2D::kMaxSize leaves room for them

/// Two adjacent texels of a row.
template <class T>
struct TexelPair {
  T left, right;
};

/// The 2x2 texels that a lookup blends.
template <class R>
struct TexelSquare {
  const int32_t* words;   ///< of the texture
  IntOf<R> lower, upper;  ///< index of the left texel of each row; the right one follows it in memory
  R along, across;        ///< weights of the right and the upper texels
  IntOf<R> right_weight;  ///< along · 2^kFractionBits; unused if R is double
};

// ---- texel by texel -----------------------------------------------------------------------------------------------------
//
// The 128-bit parts of register k hold the texels of lanes k, k + 4, k + 8 and k + 12, as in transpose.h.

/// Whether this build can filter texel by texel for lanes R.
template <class R>
inline constexpr bool kFiltersByTexel = false;
template <class H>
inline constexpr bool kFiltersByTexel<RealPair<H>> = kFiltersByTexel<H>;
/// Whether it also does so for srgb8a8. With 16 lanes, srgb_to_linear decodes a channel of all lanes faster than one texel at a time.
template <class R>
inline constexpr bool kDecodesSrgbByTexel = false;
template <class H>
inline constexpr bool kDecodesSrgbByTexel<RealPair<H>> = kDecodesSrgbByTexel<H>;

#if defined(__AVX2__) && defined(__F16C__)
template <>
inline constexpr bool kFiltersByTexel<RealN<8>> = true;
template <>
inline constexpr bool kDecodesSrgbByTexel<RealN<8>> = true;
/// Broadcasts element k of each 128-bit part to all four elements of that part.
template <int k>
HS_INLINE RealN<8> spread_word(RealN<8> r) {
  return RealN<8>((RealN<8>::V)_mm256_shuffle_ps((__m256)r.v, (__m256)r.v, k * 0x55));
}
/// Unpacks the channels of the two texels at the start of each part to 16 bits, multiplies them by the two weights in each word, and adds.
HS_INLINE RealN<8> weighted_sum(IntN<8> texels, IntN<8> weights) {
  const __m256i order = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, -1, 4, -1, 1, -1, 5, -1, 2, -1, 6, -1, 3, -1, 7, -1));
  const __m256i channels = _mm256_shuffle_epi8((__m256i)texels.v, order);
  return RealN<8>((RealN<8>::V)_mm256_cvtepi32_ps(_mm256_madd_epi16(channels, (__m256i)weights.v)));
}
/// Separates the left from the right texels of two pairs.
HS_INLINE TexelPair<RealN<8>> split_texels(__m256 a, __m256 b) {
  const auto real = [](__m256 v) { return RealN<8>((RealN<8>::V)v); };
  return {real(_mm256_permute2f128_ps(a, b, 0x20)), real(_mm256_permute2f128_ps(a, b, 0x31))};
}
/// Decodes an srgb8a8 texel, in the units of decode_rgba8.
HS_INLINE __m128 srgb_texel(uint32_t texel) {
  const auto pair = [](const SrgbPairs::Table& table, uint32_t code) { return load_at<double>(table[code & 255].data()); };
  const __m128d red_blue = _mm_set_pd(pair(kSrgbPairs.first, texel >> 16), pair(kSrgbPairs.first, texel));
  const __m128d green_alpha = _mm_set_pd(pair(kSrgbPairs.alpha, texel >> 24), pair(kSrgbPairs.second, texel >> 8));
  return _mm_castpd_ps(_mm_or_pd(red_blue, green_alpha));
}
/// Loads the two srgb8a8 texels at place(k), place(k + 4), …
template <class Place>
HS_INLINE TexelPair<RealN<8>> load_srgb_texels(RealN<8>, const Place& place, int k) {
  const auto a = load_at<uint64_t>(place(k)), b = load_at<uint64_t>(place(k + 4));
  const auto both = [](uint64_t x, uint64_t y) {
    return RealN<8>((RealN<8>::V)_mm256_set_m128(srgb_texel(static_cast<uint32_t>(y)), srgb_texel(static_cast<uint32_t>(x))));
  };
  return {both(a, b), both(a >> 32, b >> 32)};
}
/// Loads the two rgba16f texels at place(k), place(k + 4), …
template <class Place>
HS_INLINE TexelPair<RealN<8>> load_half_texels(RealN<8>, const Place& place, int k) {
  const __m256 a = _mm256_cvtph_ps(load_at<__m128i>(place(k))), b = _mm256_cvtph_ps(load_at<__m128i>(place(k + 4)));
  return split_texels(a, b);
}
/// Loads the two rgba32f texels at place(k), place(k + 4), …
template <class Place>
HS_INLINE TexelPair<RealN<8>> load_float_texels(RealN<8>, const Place& place, int k) {
  return split_texels(load_at<__m256>(place(k)), load_at<__m256>(place(k + 4)));
}
#endif

#ifdef __AVX512BW__
template <>
inline constexpr bool kFiltersByTexel<RealN<16>> = true;
template <int k>
HS_INLINE RealN<16> spread_word(RealN<16> r) {
  return RealN<16>((RealN<16>::V)_mm512_maskz_shuffle_ps(kAll16, (__m512)r.v, (__m512)r.v, k * 0x55));
}
HS_INLINE RealN<16> weighted_sum(IntN<16> texels, IntN<16> weights) {
  const __m512i order = _mm512_maskz_broadcast_i32x4(kAll16, _mm_setr_epi8(0, -1, 4, -1, 1, -1, 5, -1, 2, -1, 6, -1, 3, -1, 7, -1));
  const __m512i channels = _mm512_maskz_shuffle_epi8(~__mmask64{}, (__m512i)texels.v, order);
  return RealN<16>((RealN<16>::V)_mm512_maskz_cvtepi32_ps(kAll16, _mm512_maskz_madd_epi16(kAll16, channels, (__m512i)weights.v)));
}
HS_INLINE TexelPair<RealN<16>> split_texels(__m512 a, __m512 b) {
  const auto real = [](__m512 v) { return RealN<16>((RealN<16>::V)v); };
  return {real(_mm512_maskz_shuffle_f32x4(kAll16, a, b, 0x88)), real(_mm512_maskz_shuffle_f32x4(kAll16, a, b, 0xdd))};
}
template <class Place>
HS_INLINE TexelPair<RealN<16>> load_half_texels(RealN<16>, const Place& place, int k) {
  const auto two = [&](int first) {
    const __m256i halfs =
        _mm256_inserti128_si256(_mm256_castsi128_si256(load_at<__m128i>(place(first))), load_at<__m128i>(place(first + 4)), 1);
    return _mm512_maskz_cvtph_ps(kAll16, halfs);
  };
  return split_texels(two(k), two(k + 8));
}
template <class Place>
HS_INLINE TexelPair<RealN<16>> load_float_texels(RealN<16>, const Place& place, int k) {
  const auto two = [&](int first) {
    const __m512 low = _mm512_castps256_ps512(load_at<__m256>(place(first)));
    return _mm512_castpd_ps(_mm512_maskz_insertf64x4(0xff, _mm512_castps_pd(low), load_at<__m256d>(place(first + 4)), 1));
  };
  return split_texels(two(k), two(k + 8));
}
#endif

/// Loads the two texels at place(k), place(k + 4), … place(i) is the address of texel i.
template <TexelFormat format, int W, class Place>
HS_INLINE TexelPair<RealN<W>> load_texels(const Place& place, int k) {
  if constexpr (format == TexelFormat::rgba16f) return load_half_texels(RealN<W>{}, place, k);
  if constexpr (format == TexelFormat::rgba32f) return load_float_texels(RealN<W>{}, place, k);
  if constexpr (format == TexelFormat::srgb8a8) return load_srgb_texels(RealN<W>{}, place, k);
}

/// Returns the four channels of the texels k, k + 4, … of a row, filtered along the row. For rgba8 they are multiplied by −2^kFractionBits:
/// the negated weights fit into 16 bits.
template <TexelFormat format, int k, int W>
HS_INLINE RealN<W> filtered_along(const TexelSquare<RealN<W>>& s, const IntN<W>& row) {
  const ScalarIndices<W> at(row);  // one for each k, so that g++ does not keep all indices in registers
  if constexpr (format == TexelFormat::rgba8) {
    const IntN<W> weights = ((s.right_weight - (1 << kFractionBits)) & 0xffff) | (-s.right_weight << 16);
    const IntN<W> texels = load_quarters(
        IntN<W>{}, [&](int lane) { return s.words + at[lane]; }, k);
    return weighted_sum(texels, as_int(spread_word<k>(RealN<W>(as_real(weights)))));
  } else {
    constexpr int words = format == TexelFormat::srgb8a8 ? 1 : format == TexelFormat::rgba16f ? 2 : 4;
    const TexelPair<RealN<W>> texels = load_texels<format, W>([&](int lane) { return s.words + words * at[lane]; }, k);
    return lerp(texels.left, texels.right, spread_word<k>(s.along));
  }
}

/// Filters texels, in linear values or, for 8-bit formats, in the units of decode_rgba8.
template <TexelFormat format, int W>
HS_INLINE vec4<RealN<W>> filtered_by_texel(const TexelSquare<RealN<W>>& s) {
  using R = RealN<W>;
  const IntN<W> lower(s.lower), upper(s.upper);  // copies, because g++ would write members of s to memory
  const auto texels = [&]<int k>(std::integral_constant<int, k>) __attribute__((always_inline)) {  // as in Texture2D::sample
    return as_int(lerp(filtered_along<format, k>(s, lower), filtered_along<format, k>(s, upper), spread_word<k>(s.across)));
  };
  const std::array<IntN<W>, 4> channels =
      transposed_4x4(std::array<IntN<W>, 4>{texels(std::integral_constant<int, 0>{}), texels(std::integral_constant<int, 1>{}),
                                            texels(std::integral_constant<int, 2>{}), texels(std::integral_constant<int, 3>{})});
  const auto channel = [&](std::size_t i) {
    const R value(as_real(channels[i]));
    if constexpr (format != TexelFormat::rgba8)
      return value;
    else
      return fma(value, R(-1.0f / (1 << kFractionBits)), R(0.0f));  // adds 0, because the product is −0 for a sum of 0
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <TexelFormat format, class H>
HS_INLINE vec4<RealPair<H>> filtered_by_texel(const TexelSquare<RealPair<H>>& s) {
  const auto a =
      filtered_by_texel<format>(TexelSquare<H>{s.words, s.lower.low, s.upper.low, s.along.low, s.across.low, s.right_weight.low});
  const auto b =
      filtered_by_texel<format>(TexelSquare<H>{s.words, s.lower.high, s.upper.high, s.along.high, s.across.high, s.right_weight.high});
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}, {a.w, b.w}};
}

// ---- channel by channel -------------------------------------------------------------------------------------------------

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

/// Filters channel k of rgba8 texels. The result is from 0 to 255.
template <class R>
HS_INLINE R filtered_codes(const TexelPair<IntOf<R>>& lower, const TexelPair<IntOf<R>>& upper, R along, R across, int k) {
  const auto row = [&](const TexelPair<IntOf<R>>& of) {
    const OffsetCode<R> left = offset_code<R>(of.left, k), right = offset_code<R>(of.right, k);
    return fma(along, right.value - left.value, left.value - left.offset);  // both differences are exact
  };
  return lerp(row(lower), row(upper), across);
}

/// Filters the channels of 8-bit texels that Value has, in the units of decode_rgba8.
template <class Value, TexelFormat format, class R>
HS_INLINE Value filtered_by_channel(const TexelSquare<R>& s) {
  const auto pair = [&](IntOf<R> left) {
    const auto words = gather_row<2>(s.words, left);
    return TexelPair<IntOf<R>>{words[0], words[1]};
  };
  const TexelPair<IntOf<R>> lower = pair(s.lower), upper = pair(s.upper);
  if constexpr (std::is_same_v<R, double> || format == TexelFormat::srgb8a8) {
    const auto row = [&](const TexelPair<IntOf<R>>& of) {
      return lerp(decode_rgba8<Value, format, R>(of.left), decode_rgba8<Value, format, R>(of.right), s.along);
    };
    return lerp(row(lower), row(upper), s.across);
  } else {
    Value mean;
    for (int k = 0; k < (std::is_same_v<Value, vec3<R>> ? 3 : 4); ++k) mean[k] = filtered_codes<R>(lower, upper, s.along, s.across, k);
    return mean;
  }
}

/// Filters rgba16f texels.
template <class R>
HS_INLINE vec4<R> filtered_halfs(const TexelSquare<R>& s) {
  const auto row = [&](IntOf<R> left) {
    const auto words = gather_row<4>(s.words, IntOf<R>(left << 1));
    return lerp(decode_rgba16f<R>(words[0], words[1]), decode_rgba16f<R>(words[2], words[3]), s.along);
  };
  return lerp(row(s.lower), row(s.upper), s.across);
}

/// Filters rgba32f texels.
template <class R>
HS_INLINE vec4<R> filtered_floats(const TexelSquare<R>& s) {
  const auto texel = [&](IntOf<R> word) {
    const auto words = gather_row<4>(s.words, word);
    return vec4<R>(as_real(words[0]), as_real(words[1]), as_real(words[2]), as_real(words[3]));
  };
  const auto row = [&](IntOf<R> left) { return lerp(texel(left << 2), texel((left << 2) + 4), s.along); };
  return lerp(row(s.lower), row(s.upper), s.across);
}

// ---- only alpha ---------------------------------------------------------------------------------------------------------

/// Loads base[i] and base[i + 1] into the low and the high half of each lane.
HS_INLINE int32_t gather_adjacent(const uint16_t* base, int32_t i) { return static_cast<int32_t>(base[i] | uint32_t{base[i + 1]} << 16); }
template <int W>
HS_INLINE IntN<W> gather_adjacent(const uint16_t* base, IntN<W> i) {
  using V [[maybe_unused]] = typename IntN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return IntN<W>((V)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), kAll16, (__m512i)i.v, base, 2));
#endif
#ifdef __AVX2__
  [[maybe_unused]] const auto* words = reinterpret_cast<const int32_t*>(base);
  if constexpr (W == 8) return IntN<W>((V)_mm256_i32gather_epi32(words, (__m256i)i.v, 2));
  if constexpr (W == 4) return IntN<W>((V)_mm_i32gather_epi32(words, (__m128i)i.v, 2));
#endif
  IntN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = gather_adjacent(base, i.v[k]);
  return r;
}
template <class H>
HS_INLINE IntPair<H> gather_adjacent(const uint16_t* base, IntPair<H> i) {
  return {gather_adjacent(base, i.low), gather_adjacent(base, i.high)};
}

/// The 2x2 8-bit alpha values that a lookup blends.
template <class R>
struct AlphaSquare {
  const uint16_t* columns;  ///< of the texture: the alpha of each texel in the low byte, and of the one above it in the high byte
  IntOf<R> left;            ///< index of the left column; the right one follows it in memory
  R along, across;          ///< weights of the right and the upper texels
};

/// Filters alpha. The result is from 0 to 255. One gather loads all four values. The result is bit-identical to alpha in the four-channel
/// filters, because the sum along a row is exact.
template <class R>
HS_INLINE R filtered_alpha(const AlphaSquare<R>& s) {
  const IntOf<R> codes = gather_adjacent(s.columns, s.left);
  const auto code = [&](int byte) { return to_real<R>((codes >> 8 * byte) & 255); };
  return lerp(lerp(code(0), code(2), s.along), lerp(code(1), code(3), s.along), s.across);
}

// ---- all lanes and formats ----------------------------------------------------------------------------------------------

/// Filters 2x2 texels and returns linear values (rgba16f, rgba32f) or the units of decode_rgba8. Value selects the channels: vec4, and for
/// 8-bit formats also vec3 (no alpha).
template <class Value, TexelFormat format, class R>
HS_INLINE Value filtered(const TexelSquare<R>& s) {
  if constexpr (kFiltersByTexel<R> && (format != TexelFormat::srgb8a8 || kDecodesSrgbByTexel<R>))
    return Value(filtered_by_texel<format>(s));
  else if constexpr (format == TexelFormat::rgba16f)
    return filtered_halfs(s);
  else if constexpr (format == TexelFormat::rgba32f)
    return filtered_floats(s);
  else
    return filtered_by_channel<Value, format>(s);
}

}  // namespace halfspace::HS_LANES::detail
