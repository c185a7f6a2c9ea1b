// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/texel_codec.h"

#include <bit>
#include <cstring>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

constexpr bool is_packed_unorm(const TexelInfo& info) { return info.kind == TexelKind::unorm && info.bits == 0; }

// Bits of the mantissa of a channel of r11f_g11f_b10f.
constexpr int small_mantissa(int k) { return channel_bits(TexelFormat::r11f_g11f_b10f, k) - 5; }

// Returns the code of a depth, which is clamped.
template <class R>
R d24_code(R depth) {
  return encode_d24(R(clamp(depth, 0.0f, 1.0f)));
}

// A channel of a format whose channels all have the same number of bits. The code is sign-extended if its kind is signed.
template <class R>
IntOf<R> encode_channel(const TexelInfo& info, R x, bool alpha) {
  if (info.kind == TexelKind::srgb && !alpha) return linear_to_srgb(x);
  if (info.kind == TexelKind::snorm) return encode_snorm(x, info.bits);
  if (info.kind != TexelKind::floats) return encode_unorm(x, info.bits);
  if (info.bits == 32) return as_int(x);
  return IntOf<R>(float_to_half(select(abs(x) < R(std::numeric_limits<float>::infinity()), finite_half_range(x), x)));
}
template <class R>
R decode_channel(const TexelInfo& info, IntOf<R> code, bool alpha) {
  if (info.kind == TexelKind::srgb && !alpha) return srgb_to_linear<R>(code);
  if (info.kind == TexelKind::snorm) return decode_snorm<R>(code, info.bits);
  if (info.kind != TexelKind::floats) return decode_unorm<R>(code, info.bits);
  if (info.bits == 32) return as_real(code);
  if constexpr (std::is_same_v<R, float>) {
    return half_to_float(static_cast<uint16_t>(code));
  } else {
    return half_to_float(code);
  }
}

constexpr bool is_signed(TexelKind kind) { return kind == TexelKind::snorm || kind == TexelKind::sints; }

// Reads and writes the bits of channel k.
int32_t read_code(const TexelInfo& info, const std::byte* texel, int k) {
  const std::size_t bytes = info.bits / 8u;
  uint32_t code = 0;
  std::memcpy(&code, texel + static_cast<std::size_t>(k) * bytes, bytes);
  const int unused = 32 - info.bits;
  return is_signed(info.kind) ? static_cast<int32_t>(code << unused) >> unused : static_cast<int32_t>(code);
}
void write_code(const TexelInfo& info, std::byte* texel, int k, int32_t code) {
  const std::size_t bytes = info.bits / 8u;
  std::memcpy(texel + static_cast<std::size_t>(k) * bytes, &code, bytes);
}
uint32_t read_word(const std::byte* texel, std::size_t bytes = 4) {
  uint32_t word = 0;
  std::memcpy(&word, texel, bytes);
  return word;
}
template <class T>
void write(std::byte* texel, T value) {
  std::memcpy(texel, &value, sizeof value);
}

float decode_depth(TexelFormat format, const std::byte* texel) {
  uint16_t code16 = 0;
  switch (format) {
    case TexelFormat::d16: std::memcpy(&code16, texel, sizeof code16); return static_cast<float>(code16) / 65535.0f;
    case TexelFormat::d24: return static_cast<float>(read_word(texel) & 0xffffff) / kMaxD24;
    case TexelFormat::d24s8: return static_cast<float>(read_word(texel) >> 8) / kMaxD24;
    default: return std::bit_cast<float>(read_word(texel));
  }
}

void encode_depth(TexelFormat format, float depth, std::byte* texel) {
  switch (format) {
    case TexelFormat::d16: return write(texel, static_cast<uint16_t>(encode_unorm(depth, 16)));
    case TexelFormat::d24: return write(texel, static_cast<uint32_t>(d24_code(depth)));
    case TexelFormat::d24s8: return write(texel, static_cast<uint32_t>(d24_code(depth)) << 8);
    case TexelFormat::d32fs8: write(texel + 4, uint32_t{0}); [[fallthrough]];
    default: return write(texel, clamp(depth, 0.0f, 1.0f));
  }
}

}  // namespace

template <Number R>
vec4<R> nearest_texel(TexelFormat format, const vec4<R>& color) {
  const TexelInfo& info = texel_info(format);
  const R x[] = {color.x, color.y, color.z, color.w};
  R y[] = {R(0.0f), R(0.0f), R(0.0f), R(1.0f)};
  if (is_packed_unorm(info)) {
    for (int k = 0; k < info.channels; ++k) y[k] = decode_unorm<R>(encode_unorm(x[k], channel_bits(format, k)), channel_bits(format, k));
    return {y[0], y[1], y[2], y[3]};
  }
  switch (format) {
    case TexelFormat::r11f_g11f_b10f:
      for (int k = 0; k < 3; ++k) {
        const R finite = min(R(std::numeric_limits<float>::max()), x[k]);  // the order of the arguments keeps NaN
        y[k] = decode_small_float<R>(encode_small_float(finite, small_mantissa(k)), small_mantissa(k));
      }
      break;
    case TexelFormat::rgb9_e5: return vec4<R>(decode_rgb9_e5<R>(encode_rgb9_e5(vec3<R>(x[0], x[1], x[2]))), R(1.0f));
    case TexelFormat::d16: y[0] = decode_unorm<R>(encode_unorm(x[0], 16), 16); break;
    case TexelFormat::d24:
    case TexelFormat::d24s8: y[0] = d24_code(x[0]) / R(kMaxD24); break;
    case TexelFormat::d32f:
    case TexelFormat::d32fs8: y[0] = clamp(x[0], 0.0f, 1.0f); break;
    default: {
      const bool is_half = info.kind == TexelKind::floats && info.bits == 16;
      for (std::size_t k = 0; k < info.channels; ++k) {
        const R finite = is_half ? finite_half_range(x[k]) : x[k];
        y[k] = decode_channel<R>(info, encode_channel(info, finite, k == 3), k == 3);
      }
    }
  }
  return {y[0], y[1], y[2], y[3]};
}
template vec4<float> nearest_texel(TexelFormat, const vec4<float>&);
#if HALFSPACE_LANES > 1
template vec4<Real> nearest_texel(TexelFormat, const vec4<Real>&);
#endif

template <Number R>
std::array<IntOf<R>, 4> nearest_integers(TexelFormat format, const std::array<IntOf<R>, 4>& values) {
  using I = IntOf<R>;
  const TexelInfo& info = texel_info(format);
  std::array<I, 4> out{I(0), I(0), I(0), I(1)};
  for (std::size_t k = 0; k < info.channels; ++k) {
    const int bits = channel_bits(format, static_cast<int>(k));
    const I x = values[k];
    if (bits == 32) {
      out[k] = x;
    } else if (info.kind == TexelKind::uints) {
      const I largest((1 << bits) - 1);
      out[k] = select((x >> bits) == I(0), x, largest);  // the bits that do not fit include the sign
    } else {
      const I largest((1 << (bits - 1)) - 1);
      out[k] = max(min(x, largest), -largest - 1);
    }
  }
  return out;
}
template std::array<int32_t, 4> nearest_integers<float>(TexelFormat, const std::array<int32_t, 4>&);
#if HALFSPACE_LANES > 1
template std::array<Int, 4> nearest_integers<Real>(TexelFormat, const std::array<Int, 4>&);
#endif

glm::vec4 decode_texel(TexelFormat format, const std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  if (info.kind == TexelKind::depth) return {decode_depth(format, texel), 0.0f, 0.0f, 1.0f};
  glm::vec4 color(0.0f, 0.0f, 0.0f, 1.0f);
  if (info.bits != 0) {
    for (int k = 0; k < info.channels; ++k) color[k] = decode_channel<float>(info, read_code(info, texel, k), k == 3);
    return color;
  }
  const uint32_t word = read_word(texel, info.bytes);
  if (format == TexelFormat::rgb9_e5) {
    const vec3<float> shared = decode_rgb9_e5<float>(static_cast<int32_t>(word));
    return {shared.x, shared.y, shared.z, 1.0f};
  }
  for (int k = 0; k < info.channels; ++k) {
    const int bits = channel_bits(format, k);
    const int32_t code = static_cast<int32_t>(word >> channel_shift(format, k)) & ((1 << bits) - 1);
    color[k] = is_packed_unorm(info) ? decode_unorm<float>(code, bits) : decode_small_float<float>(code, small_mantissa(k));
  }
  return color;
}

void encode_texel(TexelFormat format, const glm::vec4& color, std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  if (info.kind == TexelKind::depth) return encode_depth(format, color.x, texel);
  if (info.bits != 0) {
    for (int k = 0; k < info.channels; ++k) write_code(info, texel, k, encode_channel(info, color[k], k == 3));
    return;
  }
  if (format == TexelFormat::rgb9_e5) return write(texel, encode_rgb9_e5(vec3<float>(color.x, color.y, color.z)));
  uint32_t word = 0;
  for (int k = 0; k < info.channels; ++k) {
    const int32_t code =
        is_packed_unorm(info) ? encode_unorm(color[k], channel_bits(format, k)) : encode_small_float(color[k], small_mantissa(k));
    word |= static_cast<uint32_t>(code) << channel_shift(format, k);
  }
  std::memcpy(texel, &word, info.bytes);
}

glm::ivec4 decode_integers(TexelFormat format, const std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  glm::ivec4 values(0, 0, 0, 1);
  if (format == TexelFormat::rgb10_a2ui) {
    const uint32_t word = read_word(texel);
    return {word & 1023, (word >> 10) & 1023, (word >> 20) & 1023, word >> 30};
  }
  for (int k = 0; k < info.channels; ++k) values[k] = read_code(info, texel, k);
  return values;
}

void encode_integers(TexelFormat format, const glm::ivec4& values, std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  const std::array<int32_t, 4> clamped = nearest_integers<float>(format, {values.x, values.y, values.z, values.w});
  if (format == TexelFormat::rgb10_a2ui) {
    uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word |= static_cast<uint32_t>(clamped[k]) << (10 * k);
    return write(texel, word);
  }
  for (int k = 0; k < info.channels; ++k) write_code(info, texel, k, clamped[static_cast<std::size_t>(k)]);
}

}  // namespace halfspace::HS_LANES
