// SPDX-License-Identifier: Apache-2.0
//
// Reads texels of any format from memory. The format is the same for all lanes and is examined at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "halfspace/core/texel_codec.h"
#include "halfspace/shading/texture/packed_texels.h"

namespace halfspace::HS_LANES::detail {

/// The unit in which lookups count the distances of texels: 4, 2 or 1 bytes. A texel is a whole number of units.
constexpr int texel_unit(TexelFormat format) {
  const int bytes = texel_info(format).bytes;
  return bytes % 4 == 0 ? 4 : bytes % 2 == 0 ? 2 : 1;
}

/// Loads `bytes` (1 or 2) bytes per lane from base + i · bytes, without reading beyond them. High bytes are 0.
template <class R>
HS_INLINE IntOf<R> gather_bytes(const std::byte* base, IntOf<R> i, int bytes) {
  const auto one = [&](int32_t at) {
    uint32_t word = 0;
    std::memcpy(&word, base + static_cast<std::ptrdiff_t>(at) * bytes, static_cast<std::size_t>(bytes));
    return static_cast<int32_t>(word);
  };
  if constexpr (!kIsLanes<R>) {
    return one(i);
  } else {
    IntOf<R> words(0);
    for (int k = 0; k < kWidthOf<R>; ++k) set_lane(words, k, one(lane(i, k)));
    return words;
  }
}

/// Reads the texels of a level. Its functions are not forced inline, because a lookup would contain some fifty copies of them. Index i
/// counts units (texel_unit) from `data`, which is aligned to the unit.
///
/// The units of values are those that are filtered: codes of normalized formats as integers, but linear values for the colors of sRGB, for
/// floats and for depths.
template <class R>
struct TexelReader {
  using Value = vec4<R>;
  using I = IntOf<R>;

  TexelFormat format;
  const std::byte* data;

  /// The texel codec decodes to floats; R = double takes over their values.
  using Decoded = std::conditional_t<std::is_same_v<R, double>, float, R>;

  /// Loads one unit.
  HS_INLINE I load(I i) const { return texel_unit(format) == 4 ? word(i) : gather_bytes<R>(data, i, texel_unit(format)); }
  HS_INLINE I word(I i) const { return gather(reinterpret_cast<const int32_t*>(data), i); }

  /// Returns the bits of all channels, sign-extended if the format is signed. Missing channels are 0, and alpha is 1. Not for rgb9_e5 and
  /// formats of depths.
  std::array<I, 4> codes(I i) const {
    const TexelInfo& info = texel_info(format);
    std::array<I, 4> out{I(0), I(0), I(0), I(1)};
    if (info.bits == 0) {  // packed in a word
      const I packed = load(i);
      for (int k = 0; k < info.channels; ++k)
        out[static_cast<std::size_t>(k)] = (packed >> channel_shift(format, k)) & I((1 << channel_bits(format, k)) - 1);
      return out;
    }
    const bool is_signed = info.kind == TexelKind::snorm || info.kind == TexelKind::sints;
    const auto code = [&](I bits, int shift) {  // of the info.bits bits above `shift`
      if (info.bits == 32) return bits;
      const I high = bits << (32 - info.bits - shift);
      return is_signed ? high >> (32 - info.bits) : (high >> (32 - info.bits)) & I((1 << info.bits) - 1);
    };
    const int unit = texel_unit(format), per_unit = 8 * unit / info.bits;  // channels
    for (int k = 0; k < info.channels; k += per_unit) {
      const I packed = load(i + I(k / per_unit));
      for (int n = 0; n < per_unit && k + n < info.channels; ++n) out[static_cast<std::size_t>(k + n)] = code(packed, n * info.bits);
    }
    return out;
  }

  R depth(I i) const {
    switch (format) {
      case TexelFormat::d16: return unorm16_to_linear(to_real<R>(load(i)));
      case TexelFormat::d24: return to_real<R>(word(i) & I(0xffffff)) / R(kMaxD24);
      case TexelFormat::d24s8: return to_real<R>((word(i) >> 8) & I(0xffffff)) / R(kMaxD24);
      default: return R(as_real(word(i)));
    }
  }
  /// Returns the stencil values, or 0 if the format has none.
  HS_INLINE I stencil(I i) const {
    if (!has_stencil(format)) return I(0);
    return (format == TexelFormat::d24s8 ? word(i) : word(i + I(1))) & I(255);
  }

  Value operator()(I i) const {
    // By far the most common formats.
    if (format == TexelFormat::rgba8) return decode_rgba8<Value, TexelFormat::rgba8, R>(word(i));
    if (format == TexelFormat::srgb8a8) return decode_rgba8<Value, TexelFormat::srgb8a8, R>(word(i));
    const TexelInfo& info = texel_info(format);
    Value v(R(0.0f), R(0.0f), R(0.0f), R(1.0f));
    if (info.kind == TexelKind::depth) {
      v.x = depth(i);
      return v;
    }
    if (info.kind == TexelKind::shared_exponent) return Value(vec3<R>(decode_rgb9_e5<Decoded>(word(i))), R(1.0f));
    const std::array<I, 4> code = codes(i);
    for (int k = 0; k < info.channels; ++k) v[k] = filtered_unit(info, code[static_cast<std::size_t>(k)], k);
    return v;
  }

  /// Converts a value in the units of filtering to a linear one.
  Value to_linear(const Value& v) const {
    const TexelInfo& info = texel_info(format);
    Value linear = v;
    for (int k = 0; k < info.channels; ++k) {
      const int bits = channel_bits(format, k);
      if (info.kind == TexelKind::snorm) {
        linear[k] = v[k] / R(static_cast<float>((1 << (bits - 1)) - 1));
      } else if (info.kind == TexelKind::unorm || (info.kind == TexelKind::srgb && k == 3)) {
        linear[k] = bits == 8    ? unorm8_to_linear(v[k])
                    : bits == 16 ? unorm16_to_linear(v[k])
                                 : v[k] / R(static_cast<float>((1 << bits) - 1));
      }
    }
    return linear;
  }

 private:
  HS_INLINE R filtered_unit(const TexelInfo& info, I code, int k) const {
    switch (info.kind) {
      case TexelKind::srgb: return k == 3 ? to_real<R>(code) : srgb_to_linear<R>(code);
      case TexelKind::snorm: return max(to_real<R>(code), R(static_cast<float>(1 - (1 << (info.bits - 1)))));
      case TexelKind::floats:
        if (info.bits == 32) return R(as_real(code));
        return info.bits == 16 ? low_half<R>(code) : R(decode_small_float<Decoded>(code, channel_bits(format, k) - 5));
      default: return to_real<R>(code);
    }
  }
};

}  // namespace halfspace::HS_LANES::detail
