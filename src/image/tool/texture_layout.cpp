// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/texture_layout.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string_view>

#include "halfspace/core/half.h"
#include "halfspace/core/texel_codec.h"

namespace halfspace::HS_LANES {

namespace {

// Masks of channels with equal numbers of bits that follow each other from the lowest bit, in the order of `order`, for example "bgra".
constexpr std::array<uint64_t, 4> masks_of(std::string_view order, int bits) {
  constexpr std::string_view kChannels = "rgba";
  std::array<uint64_t, 4> masks = {};
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (const std::size_t channel = kChannels.find(order[i]); channel < 4)
      masks[channel] = ((uint64_t{1} << bits) - 1) << bits * static_cast<int>(i);
  }
  return masks;
}

TextureLayout unorm(std::string_view order, int bits) {
  return mask_layout(static_cast<int>(order.size()) * bits / 8, masks_of(order, bits));
}

TextureLayout packed(TexelStorage storage) { return {storage, 4, 3, {}, {}}; }

constexpr std::array<uint64_t, 4> kRgb10A2 = {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}, kBgr10A2 = {0x3ff00000, 0xffc00, 0x3ff, 0xc0000000};
constexpr std::array<uint64_t, 4> kR5G6B5 = {0xf800, 0x7e0, 0x1f, 0}, kB5G6R5 = {0x1f, 0x7e0, 0xf800, 0};
constexpr std::array<uint64_t, 4> kR5G5B5A1 = {0xf800, 0x7c0, 0x3e, 1}, kB5G5R5A1 = {0x3e, 0x7c0, 0xf800, 1},
                                  kA1R5G5B5 = {0x7c00, 0x3e0, 0x1f, 0x8000};

// The form of decoded texels.
struct DecodedTexel {
  int channels = 0, alpha_channel = -1;
  Sample sample = Sample::uint8;
};

DecodedTexel decoded_texel(const TextureLayout& layout) {
  if (layout.storage == TexelStorage::blocks) {
    const BlockInfo info = block_info(layout.block);
    return {info.channels, info.channels == 4 ? 3 : -1, info.sample};
  }
  if (layout.storage != TexelStorage::masks) {
    const int channels = layout.channels == 2 ? 3 : layout.channels;
    return {channels, channels == 4 ? 3 : -1, Sample::float32};
  }
  const auto& masks = layout.masks;
  const int colors = masks[1] != 0 || masks[2] != 0 ? 3 : 1;
  const bool is_wide = std::ranges::any_of(masks, [](uint64_t mask) { return std::popcount(mask) > 8; });
  return {colors + (masks[3] != 0 ? 1 : 0), masks[3] != 0 ? colors : -1, is_wide ? Sample::uint16 : Sample::uint8};
}

// Scales the codes of a channel to the range of T: to the nearest code.
template <class T>
class CodeScale {
 public:
  explicit CodeScale(uint64_t mask) : mask_(mask), shift_(mask == 0 ? 0 : std::countr_zero(mask)), max_(mask >> shift_) {}

  T operator()(uint64_t texel) const {
    if (max_ == 0) return 0;
    return static_cast<T>((((texel & mask_) >> shift_) * kMax * 2 + max_) / (2 * max_));
  }

 private:
  static constexpr uint64_t kMax = std::numeric_limits<T>::max();
  uint64_t mask_;
  int shift_;
  uint64_t max_;
};

template <class T>
void decode_masks(const TextureLayout& layout, std::span<const std::byte> level, const DecodedTexel& form, std::byte* to) {
  const bool has_alpha = form.alpha_channel >= 0;
  const int colors = form.channels - (has_alpha ? 1 : 0);
  // The second of two channels is alpha.
  const std::array<CodeScale<T>, 4> scales = {CodeScale<T>(layout.masks[0]), CodeScale<T>(layout.masks[colors == 3 ? 1 : 3]),
                                              CodeScale<T>(layout.masks[2]), CodeScale<T>(layout.masks[3])};
  const auto step = static_cast<std::size_t>(layout.bytes), channels = static_cast<std::size_t>(form.channels);
  for (; !level.empty(); level = level.subspan(step), to += channels * sizeof(T)) {
    uint64_t texel = 0;
    std::memcpy(&texel, level.data(), step);
    std::array<T, 4> codes;
    for (std::size_t c = 0; c < channels; ++c) codes[c] = scales[c](texel);
    std::memcpy(to, codes.data(), channels * sizeof(T));
  }
}

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

std::array<float, 4> numbers_of(const TextureLayout& layout, const std::byte* texel) {
  std::array<float, 4> numbers = {};
  const auto each = [&](std::size_t bytes, auto&& decode) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(layout.channels); ++c) numbers[c] = decode(texel + c * bytes);
  };
  switch (layout.storage) {
    case TexelStorage::snorm8: each(1, [](const std::byte* at) { return decode_snorm<float>(load<int8_t>(at), 8); }); break;
    case TexelStorage::snorm16: each(2, [](const std::byte* at) { return decode_snorm<float>(load<int16_t>(at), 16); }); break;
    case TexelStorage::half: each(2, [](const std::byte* at) { return half_to_float(load<uint16_t>(at)); }); break;
    case TexelStorage::single: each(4, load<float>); break;
    case TexelStorage::rg11b10: {
      const auto code = load<uint32_t>(texel);
      const auto channel = [&](int shift, int bits) {
        return decode_small_float<float>(static_cast<int>(code >> shift & ((1u << bits) - 1)), bits - 5);
      };
      numbers = {channel(0, 11), channel(11, 11), channel(22, 10), 0.0f};
      break;
    }
    case TexelStorage::rgb9e5: {
      const vec3<float> color = decode_rgb9_e5<float>(load<int>(texel));
      numbers = {color.x, color.y, color.z, 0.0f};
      break;
    }
    case TexelStorage::masks:
    case TexelStorage::blocks: break;
  }
  return numbers;
}

void decode_numbers(const TextureLayout& layout, std::span<const std::byte> level, const DecodedTexel& form, std::byte* to) {
  const auto step = static_cast<std::size_t>(layout.bytes), bytes = static_cast<std::size_t>(form.channels) * sizeof(float);
  for (; !level.empty(); level = level.subspan(step), to += bytes) std::memcpy(to, numbers_of(layout, level.data()).data(), bytes);
}

uint32_t blocks_along(uint32_t texels) { return (texels + kBlockEdge - 1) / kBlockEdge; }

void decode_blocks(const TextureLayout& layout, std::span<const std::byte> level, Picture& picture) {
  const std::size_t texel = picture.pixel_bytes(), row = texel * static_cast<std::size_t>(picture.width);
  std::array<std::byte, kBlockEdge * kBlockEdge * 4 * sizeof(float)> texels;
  for (int top = 0; top < picture.height; top += kBlockEdge) {
    for (int left = 0; left < picture.width; left += kBlockEdge, level = level.subspan(static_cast<std::size_t>(layout.bytes))) {
      decode_block(layout.block, level.data(), texels.data());
      const auto bytes = texel * static_cast<std::size_t>(std::min(kBlockEdge, picture.width - left));
      for (int y = 0; y < std::min(kBlockEdge, picture.height - top); ++y) {
        std::memcpy(picture.pixels.data() + static_cast<std::size_t>(top + y) * row + static_cast<std::size_t>(left) * texel,
                    texels.data() + static_cast<std::size_t>(y) * kBlockEdge * texel, bytes);
      }
    }
  }
}

}  // namespace

TextureLayout block_layout(BlockFormat format) { return {TexelStorage::blocks, block_info(format).bytes, 0, {}, format}; }

TextureLayout channel_layout(TexelStorage storage, int channels) {
  const int bytes = storage == TexelStorage::snorm8 ? 1 : storage == TexelStorage::single ? 4 : 2;
  return {storage, bytes * channels, channels, {}, {}};
}

TextureLayout mask_layout(int bytes, const std::array<uint64_t, 4>& masks) { return {TexelStorage::masks, bytes, 0, masks, {}}; }

std::optional<TextureLayout> layout_of_dxgi_format(uint32_t format) {
  switch (format) {                                            // the names are those of the enumeration
    case 2: return channel_layout(TexelStorage::single, 4);    // R32G32B32A32_FLOAT
    case 6: return channel_layout(TexelStorage::single, 3);    // R32G32B32_FLOAT
    case 10: return channel_layout(TexelStorage::half, 4);     // R16G16B16A16_FLOAT
    case 11: return unorm("rgba", 16);                         // R16G16B16A16_UNORM
    case 13: return channel_layout(TexelStorage::snorm16, 4);  // R16G16B16A16_SNORM
    case 16: return channel_layout(TexelStorage::single, 2);   // R32G32_FLOAT
    case 24: return mask_layout(4, kRgb10A2);                  // R10G10B10A2_UNORM
    case 26: return packed(TexelStorage::rg11b10);             // R11G11B10_FLOAT
    case 28:                                                   // R8G8B8A8_UNORM
    case 29: return unorm("rgba", 8);                          // R8G8B8A8_UNORM_SRGB
    case 31: return channel_layout(TexelStorage::snorm8, 4);   // R8G8B8A8_SNORM
    case 34: return channel_layout(TexelStorage::half, 2);     // R16G16_FLOAT
    case 35: return unorm("rg", 16);                           // R16G16_UNORM
    case 37: return channel_layout(TexelStorage::snorm16, 2);  // R16G16_SNORM
    case 41: return channel_layout(TexelStorage::single, 1);   // R32_FLOAT
    case 49: return unorm("rg", 8);                            // R8G8_UNORM
    case 51: return channel_layout(TexelStorage::snorm8, 2);   // R8G8_SNORM
    case 54: return channel_layout(TexelStorage::half, 1);     // R16_FLOAT
    case 56: return unorm("r", 16);                            // R16_UNORM
    case 58: return channel_layout(TexelStorage::snorm16, 1);  // R16_SNORM
    case 61: return unorm("r", 8);                             // R8_UNORM
    case 63: return channel_layout(TexelStorage::snorm8, 1);   // R8_SNORM
    case 67: return packed(TexelStorage::rgb9e5);              // R9G9B9E5_SHAREDEXP
    case 71:                                                   // BC1_UNORM
    case 72: return block_layout(BlockFormat::bc1);            // BC1_UNORM_SRGB
    case 74:                                                   // BC2_UNORM
    case 75: return block_layout(BlockFormat::bc2);            // BC2_UNORM_SRGB
    case 77:                                                   // BC3_UNORM
    case 78: return block_layout(BlockFormat::bc3);            // BC3_UNORM_SRGB
    case 80: return block_layout(BlockFormat::bc4);            // BC4_UNORM
    case 81: return block_layout(BlockFormat::bc4_signed);     // BC4_SNORM
    case 83: return block_layout(BlockFormat::bc5);            // BC5_UNORM
    case 84: return block_layout(BlockFormat::bc5_signed);     // BC5_SNORM
    case 85: return mask_layout(2, kR5G6B5);                   // B5G6R5_UNORM
    case 86: return mask_layout(2, kA1R5G5B5);                 // B5G5R5A1_UNORM
    case 87:                                                   // B8G8R8A8_UNORM
    case 91: return unorm("bgra", 8);                          // B8G8R8A8_UNORM_SRGB
    case 88:                                                   // B8G8R8X8_UNORM
    case 93: return unorm("bgrx", 8);                          // B8G8R8X8_UNORM_SRGB
    case 95: return block_layout(BlockFormat::bc6h);           // BC6H_UF16
    case 96: return block_layout(BlockFormat::bc6h_signed);    // BC6H_SF16
    case 98:                                                   // BC7_UNORM
    case 99: return block_layout(BlockFormat::bc7);            // BC7_UNORM_SRGB
    case 115: return unorm("bgra", 4);                         // B4G4R4A4_UNORM
    default: return std::nullopt;
  }
}

std::optional<TextureLayout> layout_of_vk_format(uint32_t format) {
  switch (format) {                                            // the names are those of the enumeration
    case 2: return unorm("abgr", 4);                           // R4G4B4A4_UNORM_PACK16
    case 3: return unorm("argb", 4);                           // B4G4R4A4_UNORM_PACK16
    case 4: return mask_layout(2, kR5G6B5);                    // R5G6B5_UNORM_PACK16
    case 5: return mask_layout(2, kB5G6R5);                    // B5G6R5_UNORM_PACK16
    case 6: return mask_layout(2, kR5G5B5A1);                  // R5G5B5A1_UNORM_PACK16
    case 7: return mask_layout(2, kB5G5R5A1);                  // B5G5R5A1_UNORM_PACK16
    case 8: return mask_layout(2, kA1R5G5B5);                  // A1R5G5B5_UNORM_PACK16
    case 9:                                                    // R8_UNORM
    case 15: return unorm("r", 8);                             // R8_SRGB
    case 10: return channel_layout(TexelStorage::snorm8, 1);   // R8_SNORM
    case 16:                                                   // R8G8_UNORM
    case 22: return unorm("rg", 8);                            // R8G8_SRGB
    case 17: return channel_layout(TexelStorage::snorm8, 2);   // R8G8_SNORM
    case 23:                                                   // R8G8B8_UNORM
    case 29: return unorm("rgb", 8);                           // R8G8B8_SRGB
    case 24: return channel_layout(TexelStorage::snorm8, 3);   // R8G8B8_SNORM
    case 30:                                                   // B8G8R8_UNORM
    case 36: return unorm("bgr", 8);                           // B8G8R8_SRGB
    case 37:                                                   // R8G8B8A8_UNORM
    case 43: return unorm("rgba", 8);                          // R8G8B8A8_SRGB
    case 38: return channel_layout(TexelStorage::snorm8, 4);   // R8G8B8A8_SNORM
    case 44:                                                   // B8G8R8A8_UNORM
    case 50: return unorm("bgra", 8);                          // B8G8R8A8_SRGB
    case 58: return mask_layout(4, kBgr10A2);                  // A2R10G10B10_UNORM_PACK32
    case 64: return mask_layout(4, kRgb10A2);                  // A2B10G10R10_UNORM_PACK32
    case 70: return unorm("r", 16);                            // R16_UNORM
    case 71: return channel_layout(TexelStorage::snorm16, 1);  // R16_SNORM
    case 76: return channel_layout(TexelStorage::half, 1);     // R16_SFLOAT
    case 77: return unorm("rg", 16);                           // R16G16_UNORM
    case 78: return channel_layout(TexelStorage::snorm16, 2);  // R16G16_SNORM
    case 83: return channel_layout(TexelStorage::half, 2);     // R16G16_SFLOAT
    case 84: return unorm("rgb", 16);                          // R16G16B16_UNORM
    case 85: return channel_layout(TexelStorage::snorm16, 3);  // R16G16B16_SNORM
    case 90: return channel_layout(TexelStorage::half, 3);     // R16G16B16_SFLOAT
    case 91: return unorm("rgba", 16);                         // R16G16B16A16_UNORM
    case 92: return channel_layout(TexelStorage::snorm16, 4);  // R16G16B16A16_SNORM
    case 97: return channel_layout(TexelStorage::half, 4);     // R16G16B16A16_SFLOAT
    case 100: return channel_layout(TexelStorage::single, 1);  // R32_SFLOAT
    case 103: return channel_layout(TexelStorage::single, 2);  // R32G32_SFLOAT
    case 106: return channel_layout(TexelStorage::single, 3);  // R32G32B32_SFLOAT
    case 109: return channel_layout(TexelStorage::single, 4);  // R32G32B32A32_SFLOAT
    case 122: return packed(TexelStorage::rg11b10);            // B10G11R11_UFLOAT_PACK32
    case 123: return packed(TexelStorage::rgb9e5);             // E5B9G9R9_UFLOAT_PACK32
    case 131:                                                  // BC1_RGB_UNORM_BLOCK
    case 132: return block_layout(BlockFormat::bc1_opaque);    // BC1_RGB_SRGB_BLOCK
    case 133:                                                  // BC1_RGBA_UNORM_BLOCK
    case 134: return block_layout(BlockFormat::bc1);           // BC1_RGBA_SRGB_BLOCK
    case 135:                                                  // BC2_UNORM_BLOCK
    case 136: return block_layout(BlockFormat::bc2);           // BC2_SRGB_BLOCK
    case 137:                                                  // BC3_UNORM_BLOCK
    case 138: return block_layout(BlockFormat::bc3);           // BC3_SRGB_BLOCK
    case 139: return block_layout(BlockFormat::bc4);           // BC4_UNORM_BLOCK
    case 140: return block_layout(BlockFormat::bc4_signed);    // BC4_SNORM_BLOCK
    case 141: return block_layout(BlockFormat::bc5);           // BC5_UNORM_BLOCK
    case 142: return block_layout(BlockFormat::bc5_signed);    // BC5_SNORM_BLOCK
    case 143: return block_layout(BlockFormat::bc6h);          // BC6H_UFLOAT_BLOCK
    case 144: return block_layout(BlockFormat::bc6h_signed);   // BC6H_SFLOAT_BLOCK
    case 145:                                                  // BC7_UNORM_BLOCK
    case 146: return block_layout(BlockFormat::bc7);           // BC7_SRGB_BLOCK
    default: return std::nullopt;
  }
}

void check_texture_size(const ReadRequest& request, const TextureLayout& layout, uint32_t width, uint32_t height) {
  const DecodedTexel form = decoded_texel(layout);
  check_claimed_size(request, width, height, static_cast<uint64_t>(form.channels) * sample_bytes(form.sample));
}

std::size_t level_bytes(const TextureLayout& layout, uint32_t width, uint32_t height) {
  if (layout.storage == TexelStorage::blocks) width = blocks_along(width), height = blocks_along(height);
  return std::size_t{width} * height * static_cast<std::size_t>(layout.bytes);
}

Picture picture_of_level(const TextureLayout& layout, std::span<const std::byte> level, uint32_t width, uint32_t height) {
  const DecodedTexel form = decoded_texel(layout);
  Picture picture = empty_picture(static_cast<int>(width), static_cast<int>(height),
                                  {.channels = form.channels, .alpha_channel = form.alpha_channel, .sample = form.sample, .pixels = {}});
  if (layout.storage == TexelStorage::blocks) {
    decode_blocks(layout, level, picture);
  } else if (layout.storage != TexelStorage::masks) {
    decode_numbers(layout, level, form, picture.pixels.data());
  } else if (form.sample == Sample::uint8) {
    decode_masks<uint8_t>(layout, level, form, picture.pixels.data());
  } else {
    decode_masks<uint16_t>(layout, level, form, picture.pixels.data());
  }
  return picture;
}

}  // namespace halfspace::HS_LANES
