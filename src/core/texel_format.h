// SPDX-License-Identifier: Apache-2.0
//
// The formats in which images, attachments and textures store texels. Names are those of OpenGL's internal formats, in lower case; a format
// without a suffix is unsigned normalized. texel_codec.h converts texels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// In memory, the first channel comes first, and channels of 16 and 32 bits are in the byte order of the machine. Packed formats are one
/// word: of 32 bits with the first channel in the lowest bits, or of 16 bits with the first channel in the highest bits. Channels that a
/// format does not have are read as 0, and alpha as 1.
enum class TexelFormat : uint8_t {
  none,
  r8,  ///< [0, 1] as code/255
  rg8,
  rgb8,
  rgba8,
  srgb8,  ///< red, green and blue are encoded as sRGB, alpha is linear
  srgb8a8,
  r8_snorm,  ///< [−1, 1] as max(code/127, −1)
  rg8_snorm,
  rgb8_snorm,
  rgba8_snorm,
  r16,  ///< [0, 1] as code/65535
  rg16,
  rgb16,
  rgba16,
  r16_snorm,  ///< [−1, 1] as max(code/32767, −1)
  rg16_snorm,
  rgb16_snorm,
  rgba16_snorm,
  r16f,  ///< IEEE half; colors that are drawn beyond ±65504, and infinities, are stored as ±65504
  rg16f,
  rgb16f,
  rgba16f,
  r32f,
  rg32f,
  rgb32f,
  rgba32f,
  r8i,  ///< integers; values that the format cannot store are clamped
  rg8i,
  rgb8i,
  rgba8i,
  r8ui,
  rg8ui,
  rgb8ui,
  rgba8ui,
  r16i,
  rg16i,
  rgb16i,
  rgba16i,
  r16ui,
  rg16ui,
  rgb16ui,
  rgba16ui,
  r32i,
  rg32i,
  rgb32i,
  rgba32i,
  r32ui,
  rg32ui,
  rgb32ui,
  rgba32ui,
  rgb565,          ///< 5, 6 and 5 bits, unsigned normalized (GL_UNSIGNED_SHORT_5_6_5)
  rgb5_a1,         ///< 5, 5, 5 and 1 bits (GL_UNSIGNED_SHORT_5_5_5_1)
  rgba4,           ///< 4 bits each (GL_UNSIGNED_SHORT_4_4_4_4)
  rgb10_a2,        ///< 10, 10, 10 and 2 bits, unsigned normalized
  rgb10_a2ui,      ///< the same, integers
  r11f_g11f_b10f,  ///< unsigned floats of 11, 11 and 10 bits with 5 bits of exponent; of colors that are drawn, negative ones are stored as
                   ///< 0, and infinities as the largest finite value
  rgb9_e5,         ///< three unsigned mantissas of 9 bits with a common exponent
  d16,             ///< depth in [0, 1] as code/65535
  d24,             ///< depth as code/(2^24 − 1), in the low 24 bits of a word
  d32f,
  d24s8,  ///< a word: depth in the high 24 bits, stencil in the low 8
  d32fs8  ///< two words: depth, and stencil in the low 8 bits
};
inline constexpr std::size_t kTexelFormats = static_cast<std::size_t>(TexelFormat::d32fs8) + 1;

/// What the codes of a format mean.
enum class TexelKind : uint8_t { none, unorm, srgb, snorm, floats, sints, uints, shared_exponent, depth };

struct TexelInfo {
  std::string_view name;
  TexelKind kind;
  uint8_t channels;  ///< 1 to 4; for depth formats 1
  uint8_t bits;      ///< per channel; 0 for packed and depth formats
  uint8_t bytes;     ///< per texel
};

namespace detail {

constexpr std::array<TexelInfo, kTexelFormats> make_texel_infos() {
  using enum TexelKind;
  std::array<TexelInfo, kTexelFormats> infos{};
  const auto set = [&](TexelFormat f, std::string_view name, TexelKind kind, int channels, int bits, int bytes) {
    infos[static_cast<std::size_t>(f)] = {name, kind, static_cast<uint8_t>(channels), static_cast<uint8_t>(bits),
                                          static_cast<uint8_t>(bytes)};
  };
  // Formats with 1 to 4 channels, which are consecutive in the enumeration.
  const auto set_four = [&](TexelFormat first, std::array<std::string_view, 4> names, TexelKind kind, int bits) {
    for (int n = 1; n <= 4; ++n) {
      const auto f = static_cast<TexelFormat>(static_cast<int>(first) + n - 1);
      set(f, names[static_cast<std::size_t>(n - 1)], kind, n, bits, n * bits / 8);
    }
  };
  set(TexelFormat::none, "none", none, 0, 0, 0);
  set_four(TexelFormat::r8, {"r8", "rg8", "rgb8", "rgba8"}, unorm, 8);
  set(TexelFormat::srgb8, "srgb8", srgb, 3, 8, 3);
  set(TexelFormat::srgb8a8, "srgb8a8", srgb, 4, 8, 4);
  set_four(TexelFormat::r8_snorm, {"r8_snorm", "rg8_snorm", "rgb8_snorm", "rgba8_snorm"}, snorm, 8);
  set_four(TexelFormat::r16, {"r16", "rg16", "rgb16", "rgba16"}, unorm, 16);
  set_four(TexelFormat::r16_snorm, {"r16_snorm", "rg16_snorm", "rgb16_snorm", "rgba16_snorm"}, snorm, 16);
  set_four(TexelFormat::r16f, {"r16f", "rg16f", "rgb16f", "rgba16f"}, floats, 16);
  set_four(TexelFormat::r32f, {"r32f", "rg32f", "rgb32f", "rgba32f"}, floats, 32);
  set_four(TexelFormat::r8i, {"r8i", "rg8i", "rgb8i", "rgba8i"}, sints, 8);
  set_four(TexelFormat::r8ui, {"r8ui", "rg8ui", "rgb8ui", "rgba8ui"}, uints, 8);
  set_four(TexelFormat::r16i, {"r16i", "rg16i", "rgb16i", "rgba16i"}, sints, 16);
  set_four(TexelFormat::r16ui, {"r16ui", "rg16ui", "rgb16ui", "rgba16ui"}, uints, 16);
  set_four(TexelFormat::r32i, {"r32i", "rg32i", "rgb32i", "rgba32i"}, sints, 32);
  set_four(TexelFormat::r32ui, {"r32ui", "rg32ui", "rgb32ui", "rgba32ui"}, uints, 32);
  set(TexelFormat::rgb565, "rgb565", unorm, 3, 0, 2);
  set(TexelFormat::rgb5_a1, "rgb5_a1", unorm, 4, 0, 2);
  set(TexelFormat::rgba4, "rgba4", unorm, 4, 0, 2);
  set(TexelFormat::rgb10_a2, "rgb10_a2", unorm, 4, 0, 4);
  set(TexelFormat::rgb10_a2ui, "rgb10_a2ui", uints, 4, 0, 4);
  set(TexelFormat::r11f_g11f_b10f, "r11f_g11f_b10f", floats, 3, 0, 4);
  set(TexelFormat::rgb9_e5, "rgb9_e5", shared_exponent, 3, 0, 4);
  set(TexelFormat::d16, "d16", depth, 1, 0, 2);
  set(TexelFormat::d24, "d24", depth, 1, 0, 4);
  set(TexelFormat::d32f, "d32f", depth, 1, 0, 4);
  set(TexelFormat::d24s8, "d24s8", depth, 1, 0, 4);
  set(TexelFormat::d32fs8, "d32fs8", depth, 1, 0, 8);
  return infos;
}
inline constexpr std::array<TexelInfo, kTexelFormats> kTexelInfos = make_texel_infos();

}  // namespace detail

constexpr const TexelInfo& texel_info(TexelFormat f) { return detail::kTexelInfos[static_cast<std::size_t>(f)]; }

/// Returns the bits of channel k of a format that is neither a depth format nor rgb9_e5.
constexpr int channel_bits(TexelFormat f, int k) {
  if (f == TexelFormat::rgb565) return k == 1 ? 6 : 5;
  if (f == TexelFormat::rgb5_a1) return k == 3 ? 1 : 5;
  if (f == TexelFormat::rgba4) return 4;
  if (f == TexelFormat::rgb10_a2 || f == TexelFormat::rgb10_a2ui) return k == 3 ? 2 : 10;
  if (f == TexelFormat::r11f_g11f_b10f) return k == 2 ? 10 : 11;
  return texel_info(f).bits;
}

/// Returns the lowest bit of channel k in the word of a packed format, for which channel_bits() is defined.
constexpr int channel_shift(TexelFormat f, int k) {
  int before = 0;
  for (int i = 0; i < k; ++i) before += channel_bits(f, i);
  return texel_info(f).bytes == 2 ? 16 - before - channel_bits(f, k) : before;
}

/// The type of a color of a fragment, which must be that of its attachment.
enum class ColorType : uint8_t { real, signed_integer, unsigned_integer };
constexpr ColorType color_type(TexelFormat f) {
  const TexelKind kind = texel_info(f).kind;
  return kind == TexelKind::sints ? ColorType::signed_integer : kind == TexelKind::uints ? ColorType::unsigned_integer : ColorType::real;
}

constexpr bool is_integer(TexelFormat f) { return texel_info(f).kind == TexelKind::sints || texel_info(f).kind == TexelKind::uints; }
constexpr bool is_depth(TexelFormat f) { return texel_info(f).kind == TexelKind::depth; }
constexpr bool has_stencil(TexelFormat f) { return f == TexelFormat::d24s8 || f == TexelFormat::d32fs8; }

}  // namespace halfspace::HS_LANES
