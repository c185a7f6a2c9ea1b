// SPDX-License-Identifier: Apache-2.0
//
// Codecs of the color and depth formats. Tiles and images store some formats differently.
#pragma once

#include <cstring>

#include "halfspace/core/half.h"
#include "halfspace/core/srgb.h"
#include "halfspace/core/texel_codec.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

// ---- color -----------------------------------------------------------------------------------------------------

/// Returns true if colors are clamped before blending (OpenGL 4.6, section 17.3.6), to lowest_value() and 1.
constexpr bool is_fixed_point(ColorFormat f) {
  const TexelKind kind = texel_info(f).kind;
  return kind == TexelKind::unorm || kind == TexelKind::srgb || kind == TexelKind::snorm;
}
constexpr float lowest_value(ColorFormat f) { return texel_info(f).kind == TexelKind::snorm ? -1.0f : 0.0f; }

/// Tiles store rgba8 and srgb8a8 as one word per pixel, rgba16f as a plane of halves for each channel, and all other formats as a plane of
/// floats or 32-bit integers for each channel. Their values are those that the format can store. Returns the number of these planes, or 0.
constexpr int word_planes(ColorFormat f) {
  return f == ColorFormat::rgba8 || f == ColorFormat::srgb8a8 || f == ColorFormat::rgba16f ? 0 : texel_info(f).channels;
}
/// Returns the size of a pixel in a tile in bytes.
constexpr int bytes_in_tile(ColorFormat f) { return word_planes(f) != 0 ? 4 * word_planes(f) : bytes_per_pixel(f); }
/// Returns true if planes of words contain the texels of the image, without conversion.
constexpr bool has_word_channels(ColorFormat f) { return texel_info(f).bits == 32; }

/// Returns plane k of a planar buffer, or plane 0 for 8-bit formats.
template <class T>
T* plane(ColorBuffer& b, int k) {
  return reinterpret_cast<T*>(b.bytes.data()) + k * kMaxTilePixels;
}
template <class T>
const T* plane(const ColorBuffer& b, int k) {
  return reinterpret_cast<const T*>(b.bytes.data()) + k * kMaxTilePixels;
}

HS_INLINE Real decode8(ColorFormat format, Int code, bool alpha) {
  return format == ColorFormat::srgb8a8 && !alpha ? srgb_to_linear<Real>(code) : unorm8_to_linear(to_real<Real>(code));
}
HS_INLINE Int encode8(ColorFormat format, Real value, bool alpha) {
  return format == ColorFormat::srgb8a8 && !alpha ? linear_to_srgb(value) : linear_to_unorm8(value);
}

/// Loads the halves of a packet as floats. R: Real.
template <class R>
HS_INLINE R load_halves(const uint16_t* p) {
  if constexpr (std::is_same_v<R, float>) {
    return half_to_float(*p);
#if defined(__F16C__) && defined(__AVX2__)
  } else if constexpr (kLanes == 8) {
    return R((typename R::V)_mm256_cvtph_ps(load<__m128i>(p)));  // without widening to 32-bit integers
#endif
  } else {
    using Halves __attribute__((vector_size(2 * kLanes))) = uint16_t;
    return half_to_float(IntOf<R>(__builtin_convertvector(load<Halves>(p), typename IntOf<R>::V)));
  }
}
/// Stores the nearest finite halves of the lanes in mask. R: Real.
template <class R>
HS_INLINE void store_halves(uint16_t* p, R x, MaskOf<R> mask) {
  if constexpr (std::is_same_v<R, float>) {
    if (mask) *p = float_to_finite_half(x);
#if defined(__F16C__) && defined(__AVX2__)
  } else if constexpr (kLanes == 8) {
    const __m128i halves = _mm256_cvtps_ph((__m256)finite_half_range(x).v, _MM_FROUND_TO_NEAREST_INT);
    const __m256i lanes = (__m256i)mask.v;
    const __m128i written = _mm_packs_epi32(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1));
    store(p, _mm_blendv_epi8(load<__m128i>(p), halves, written));
#endif
  } else {
    using Halves __attribute__((vector_size(2 * kLanes))) = uint16_t;
    const Halves halves = __builtin_convertvector(float_to_finite_half(x).v, Halves);
    const Halves lanes = __builtin_convertvector(mask.v, Halves), old = load<Halves>(p);
    store(p, (halves & lanes) | (old & ~lanes));
  }
}

inline constexpr float kRoundingBias = 0x1p23f;
/// Packs four integers from 0 to 255 into a word, with the first in the lowest byte. c: the integers plus kRoundingBias. In [2^23, 2^24),
/// the ulp of a float is 1, so the lowest byte of each has the integer. The shifts move the other bits out of the word.
HS_INLINE Int pack_biased(const PacketColor& c) {
  return (as_int(c[0]) ^ as_int(Real(kRoundingBias))) | as_int(c[1]) << 8 | as_int(c[2]) << 16 | as_int(c[3]) << 24;
}
/// Rounds four values in [0, 255] to integers and packs them.
HS_INLINE Int pack_rounded(const PacketColor& c) {
  const Real bias(kRoundingBias);
  return pack_biased({c[0] + bias, c[1] + bias, c[2] + bias, c[3] + bias});
}

/// Returns the 8-bit values of the four channels in one word, with red in the lowest byte.
template <ColorFormat format>
HS_INLINE Int packed_codes(const PacketColor& c) {
  if constexpr (format == ColorFormat::rgba8) {  // as linear_to_unorm8(), with fewer operations
    const auto biased = [](Real x) { return fma(clamp(x, 0.0f, 1.0f), Real(255.0f), Real(kRoundingBias)); };
    return pack_biased({biased(c[0]), biased(c[1]), biased(c[2]), biased(c[3])});
  } else {
    return encode8(format, c[0], false) | encode8(format, c[1], false) << 8 | encode8(format, c[2], false) << 16 |
           encode8(format, c[3], true) << 24;
  }
}

/// Returns the packed codes of the packet that starts with pixel `first` of an 8-bit format.
HS_INLINE Int read_codes(const ColorBuffer& buffer, std::size_t first) { return load<Int>(plane<int32_t>(buffer, 0) + first); }
/// Returns one channel of packed codes, from 0 to 255.
HS_INLINE Int code_of(Int codes, int channel) { return (codes >> (8 * channel)) & Int(0xff); }
/// Returns the codes in `codes` for the enabled channels, and those in `old` for the others.
HS_INLINE Int merged_codes(Int codes, Int old, const ColorMask& channels) {
  const auto kept = [&](int k) { return channels[k] ? 0u : 0xffu << (8 * k); };
  const Int keep(static_cast<int32_t>(kept(0) | kept(1) | kept(2) | kept(3)));
  return (old & keep) | (codes & ~keep);
}
/// Writes packed codes to the lanes in mask.
HS_INLINE void write_codes(ColorBuffer& buffer, std::size_t first, Mask mask, Int codes) {
  int32_t* to = plane<int32_t>(buffer, 0) + first;
  store(to, select(mask, codes, load<Int>(to)));
}

/// Returns channel k of the packet that starts with pixel `first`, as linear floats.
template <ColorFormat format>
HS_INLINE Real read_channel(const ColorBuffer& buffer, std::size_t first, int k) {
  if constexpr (word_planes(format) != 0) {
    return k < word_planes(format) ? load<Real>(plane<float>(buffer, k) + first) : Real(k == 3 ? 1.0f : 0.0f);
  } else if constexpr (format == ColorFormat::rgba16f) {
    return load_halves<Real>(plane<uint16_t>(buffer, k) + first);
  } else {
    return decode8(format, code_of(read_codes(buffer, first), k), k == 3);
  }
}

/// Returns the color of a format with planes of words that is nearest to a color.
PacketColor nearest_color(ColorFormat format, const PacketColor& color);

/// A color as stored in an image. Only bytes_per_pixel(format) bytes are used.
using PixelBytes = std::array<std::byte, 16>;
PixelBytes encode_pixel(ColorFormat format, const PacketColor& color);

/// Returns a color in all lanes, with the same bits: those of an integer format are integers.
HS_INLINE PacketColor spread_color(const glm::vec4& c) {
  return {spread<Real>(c.x), spread<Real>(c.y), spread<Real>(c.z), spread<Real>(c.w)};
}

/// Fills the buffer with one color.
void fill_buffer(ColorBuffer& buffer, const PacketColor& color);

// ---- depth -----------------------------------------------------------------------------------------------------

/// Returns a depth in [0, 1] as represented by the format (see Tile::depth). unorm values are rounded to nearest, once, as in encode_d24().
template <Number R>
HS_INLINE R depth_value(DepthFormat format, R z) {
  const R two_to_23(0x1p23f);
  if (format == DepthFormat::d24) return encode_d24(z);
  if (format == DepthFormat::d16) return fma(z, R(65535.0f), two_to_23) - two_to_23;
  return z;
}

// Depth and stencil of one pixel, converted between image and tile.
struct Depth16 {
  using Image = uint16_t;
  static void load(Image i, float& depth, uint8_t&) { depth = static_cast<float>(i); }
  static Image store(float depth, uint8_t) { return static_cast<Image>(depth); }
};
struct Depth24 {
  using Image = uint32_t;
  static void load(Image i, float& depth, uint8_t&) { depth = static_cast<float>(i & 0xffffff); }
  static Image store(float depth, uint8_t) { return static_cast<Image>(depth); }
};
struct Depth32 {
  using Image = float;
  static void load(Image i, float& depth, uint8_t&) { depth = i; }
  static Image store(float depth, uint8_t) { return depth; }
};
struct Depth24Stencil8 {
  using Image = uint32_t;
  static void load(Image i, float& depth, uint8_t& stencil) {
    depth = static_cast<float>(i >> 8);
    stencil = static_cast<uint8_t>(i);
  }
  static Image store(float depth, uint8_t stencil) { return static_cast<Image>(depth) << 8 | stencil; }
};
struct Depth32Stencil8 {
  using Image = DepthStencil;
  static void load(const Image& i, float& depth, uint8_t& stencil) {
    depth = i.depth;
    stencil = static_cast<uint8_t>(i.stencil);
  }
  static Image store(float depth, uint8_t stencil) { return {depth, stencil}; }
};

// Calls f with the codec of a format.
template <class F>
void with_codec(DepthFormat format, F f) {
  switch (format) {
    case DepthFormat::d16: return f(Depth16{});
    case DepthFormat::d24: return f(Depth24{});
    case DepthFormat::d32f: return f(Depth32{});
    case DepthFormat::d24s8: return f(Depth24Stencil8{});
    case DepthFormat::d32fs8: return f(Depth32Stencil8{});
    default: return;
  }
}

}  // namespace halfspace::HS_LANES
