// SPDX-License-Identifier: Apache-2.0
#include "oracle/texels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "halfspace/core/srgb.h"
#include "oracle/arithmetic.h"

namespace halfspace::oracle {

namespace {

// A channel: its position in the texel, and what its code means.
struct Channel {
  TexelKind kind;
  int first_bit, bits;
};

Channel channel_of(TexelFormat format, int k) {
  const TexelInfo& info = texel_info(format);
  if (format == TexelFormat::rgb565) return {TexelKind::unorm, k == 0 ? 11 : k == 1 ? 5 : 0, k == 1 ? 6 : 5};
  if (format == TexelFormat::rgb5_a1) return {TexelKind::unorm, k == 3 ? 0 : 11 - 5 * k, k == 3 ? 1 : 5};
  if (format == TexelFormat::rgba4) return {TexelKind::unorm, 12 - 4 * k, 4};
  if (format == TexelFormat::rgb10_a2 || format == TexelFormat::rgb10_a2ui) return {info.kind, 10 * k, k == 3 ? 2 : 10};
  if (format == TexelFormat::r11f_g11f_b10f) return {TexelKind::floats, 11 * k, k == 2 ? 10 : 11};
  return {info.kind == TexelKind::srgb && k == 3 ? TexelKind::unorm : info.kind, info.bits * k, info.bits};
}

uint32_t mask_of(int bits) { return bits == 32 ? 0xffffffffu : (1u << bits) - 1; }

// A float of 10, 11 or 16 bits has 5 bits of exponent. Only the one of 16 bits has a sign.
int mantissa_bits(int bits) { return bits == 16 ? 10 : bits - 5; }

float decode_float(uint32_t code, int bits) {
  if (bits == 32) return std::bit_cast<float>(code);
  const int mantissa_size = mantissa_bits(bits);
  const bool is_negative = bits == 16 && (code & 0x8000) != 0;
  const auto exponent = static_cast<int>(code >> mantissa_size & 31), mantissa = static_cast<int>(code & mask_of(mantissa_size));
  if (exponent == 31 && mantissa != 0)
    return std::bit_cast<float>((is_negative ? 0x80000000u : 0u) | 0x7fc00000u | static_cast<uint32_t>(mantissa) << (23 - mantissa_size));
  const double size = exponent == 31  ? HUGE_VAL
                      : exponent == 0 ? std::ldexp(mantissa, -14 - mantissa_size)
                                      : std::ldexp((1 << mantissa_size) + mantissa, exponent - 15 - mantissa_size);
  return static_cast<float>(is_negative ? -size : size);
}

// Rounds to the nearest code, ties to even. Infinities and values that are too large become the largest finite value; without a sign,
// negative values become 0.
uint32_t encode_float(float x, int bits) {
  if (bits == 32) return std::bit_cast<uint32_t>(x);
  const int mantissa_size = mantissa_bits(bits);
  const uint32_t sign = bits == 16 ? std::bit_cast<uint32_t>(x) >> 16 & 0x8000u : 0u;
  const uint32_t quiet = 31u << mantissa_size | 1u << (mantissa_size - 1);
  if (std::isnan(x)) return bits == 16 ? sign | quiet | (std::bit_cast<uint32_t>(x) >> 13 & 0x3ffu) : quiet;
  const double largest = std::ldexp(2.0 - std::ldexp(1.0, -mantissa_size), 15);
  const double size = bits != 16 && x < 0.0f ? 0.0 : std::fmin(std::fabs(static_cast<double>(x)), largest);
  if (size < 0x1p-14) return sign | static_cast<uint32_t>(std::nearbyint(std::ldexp(size, 14 + mantissa_size)));
  const int exponent = std::ilogb(size);
  // From 2^m to 2^(m + 1), which carries into the exponent.
  const auto mantissa = static_cast<uint32_t>(std::nearbyint(std::ldexp(size, mantissa_size - exponent)));
  return sign | ((static_cast<uint32_t>(exponent + 14) << mantissa_size) + mantissa);
}

float decode(const Channel& channel, uint32_t code) {
  const auto signed_code = static_cast<int32_t>(code << (32 - channel.bits)) >> (32 - channel.bits);
  switch (channel.kind) {
    case TexelKind::unorm: return static_cast<float>(static_cast<double>(code) / mask_of(channel.bits));
    case TexelKind::snorm: return static_cast<float>(std::fmax(static_cast<double>(signed_code) / mask_of(channel.bits - 1), -1.0));
    case TexelKind::srgb: return kSrgbToLinear[code];
    case TexelKind::sints: return std::bit_cast<float>(signed_code);
    case TexelKind::uints: return std::bit_cast<float>(code);
    default: return decode_float(code, channel.bits);
  }
}

uint32_t encode(const Channel& channel, float x) {
  switch (channel.kind) {  // the products are exact
    case TexelKind::unorm:
      return static_cast<uint32_t>(std::nearbyint(static_cast<double>(clamped(x, 0.0f, 1.0f)) * mask_of(channel.bits)));
    case TexelKind::snorm:
      return static_cast<uint32_t>(
          static_cast<int32_t>(std::nearbyint(static_cast<double>(clamped(x, -1.0f, 1.0f)) * mask_of(channel.bits - 1))));
    case TexelKind::srgb: return static_cast<uint32_t>(linear_to_srgb(x));
    case TexelKind::sints: {
      const auto largest = static_cast<int32_t>(mask_of(channel.bits - 1));
      return static_cast<uint32_t>(std::clamp(std::bit_cast<int32_t>(x), -largest - 1, largest));
    }
    case TexelKind::uints: return std::min(std::bit_cast<uint32_t>(x), mask_of(channel.bits));
    default: return encode_float(x, channel.bits);
  }
}

}  // namespace

glm::vec4 read_texel(TexelFormat format, const std::byte* texel) {
  glm::vec4 color(0.0f, 0.0f, 0.0f, is_integer(format) ? std::bit_cast<float>(1) : 1.0f);
  for (int k = 0; k < texel_info(format).channels; ++k) {
    const Channel channel = channel_of(format, k);
    uint64_t bits = 0;
    const int first_byte = channel.first_bit / 8, end_byte = (channel.first_bit + channel.bits + 7) / 8;
    std::memcpy(&bits, texel + first_byte, static_cast<std::size_t>(end_byte - first_byte));
    color[k] = decode(channel, static_cast<uint32_t>(bits >> (channel.first_bit % 8)) & mask_of(channel.bits));
  }
  return color;
}

void write_texel(TexelFormat format, const glm::vec4& color, std::byte* texel) {
  std::memset(texel, 0, texel_info(format).bytes);
  for (int k = 0; k < texel_info(format).channels; ++k) {
    const Channel channel = channel_of(format, k);
    const uint64_t bits = static_cast<uint64_t>(encode(channel, color[k]) & mask_of(channel.bits)) << (channel.first_bit % 8);
    const int first_byte = channel.first_bit / 8, end_byte = (channel.first_bit + channel.bits + 7) / 8;
    for (int i = first_byte; i < end_byte; ++i) texel[i] |= static_cast<std::byte>(bits >> (8 * (i - first_byte)));
  }
}

}  // namespace halfspace::oracle
