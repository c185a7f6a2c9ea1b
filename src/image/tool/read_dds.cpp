// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <optional>

#include "halfspace/image/tool/mapped_file.h"
#include "halfspace/image/tool/texture_file.h"
#include "halfspace/image/tool/texture_layout.h"

namespace halfspace::HS_LANES {

namespace {

// Offsets and sizes in bytes. The header follows the 4 bytes of the signature.
constexpr std::size_t kHeaderBytes = 128, kExtendedBytes = 20;
constexpr std::size_t kHeight = 12, kWidth = 16, kDepth = 24, kPixelFlags = 80, kFourCc = 84, kBitCount = 88, kMasks = 92, kCaps2 = 112;
constexpr uint32_t kDepthCaps = 0x200000, kCubeCaps = 0x200, kExtendedCube = 0x4, kExtended2D = 3;
constexpr uint32_t kHasAlpha = 0x1, kHasFourCc = 0x4, kRgb = 0x40, kLuminance = 0x20000;

constexpr uint32_t four_cc(const char (&code)[5]) {
  uint32_t number = 0;
  for (int i = 0; i < 4; ++i) number |= static_cast<uint32_t>(static_cast<unsigned char>(code[i])) << 8 * i;
  return number;
}

struct DdsFormat {
  std::optional<TextureLayout> layout;
  std::string name;  // for messages
  bool premultiplied = false;
  std::size_t data = kHeaderBytes;  // offset of level 0
};

// Returns the layout for the code of a Direct3D 9 format.
std::optional<TextureLayout> layout_of_four_cc(uint32_t code) {
  switch (code) {
    case four_cc("DXT1"): return block_layout(BlockFormat::bc1);
    case four_cc("DXT2"):
    case four_cc("DXT3"): return block_layout(BlockFormat::bc2);
    case four_cc("DXT4"):
    case four_cc("DXT5"): return block_layout(BlockFormat::bc3);
    case four_cc("ATI1"):
    case four_cc("BC4U"): return block_layout(BlockFormat::bc4);
    case four_cc("BC4S"): return block_layout(BlockFormat::bc4_signed);
    case four_cc("ATI2"):
    case four_cc("BC5U"): return block_layout(BlockFormat::bc5);
    case four_cc("BC5S"): return block_layout(BlockFormat::bc5_signed);
    case 36: return mask_layout(8, {0xffff, 0xffff0000, 0xffff00000000, 0xffff000000000000});  // A16B16G16R16
    case 110: return channel_layout(TexelStorage::snorm16, 4);                                 // Q16W16V16U16
    case 111: return channel_layout(TexelStorage::half, 1);
    case 112: return channel_layout(TexelStorage::half, 2);
    case 113: return channel_layout(TexelStorage::half, 4);
    case 114: return channel_layout(TexelStorage::single, 1);
    case 115: return channel_layout(TexelStorage::single, 2);
    case 116: return channel_layout(TexelStorage::single, 4);
    default: return std::nullopt;
  }
}

std::string name_of_four_cc(uint32_t code) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(code >> shift & 0xff);
  const bool is_text = std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0; });
  return is_text ? "the format " + text : "the Direct3D format " + std::to_string(code);
}

bool is_run_of_bits(uint32_t mask) { return mask == 0 || std::has_single_bit((uint64_t{mask} >> std::countr_zero(mask)) + 1); }

DdsFormat masked_format(std::span<const std::byte> header, uint32_t flags) {
  DdsFormat format{std::nullopt, "uncompressed pixels of an unknown kind (flags " + std::to_string(flags) + ")"};
  const uint32_t bits = number_at(header, kBitCount);
  if ((flags & (kRgb | kLuminance)) == 0 || bits % 8 != 0 || bits == 0 || bits > 32) return format;
  std::array<uint64_t, 4> masks = {};
  const std::size_t colors = (flags & kRgb) != 0 ? 3 : 1;
  for (std::size_t c = 0; c < 4; ++c) {
    const uint32_t mask = number_at(header, kMasks + 4 * c);
    if (!is_run_of_bits(mask)) throw Failure{"has the mask " + std::to_string(mask) + " for a channel; expected consecutive bits"};
    if (c < colors || (c == 3 && (flags & kHasAlpha) != 0)) masks[c] = mask;
  }
  if (masks[0] != 0) format.layout = mask_layout(static_cast<int>(bits / 8), masks);
  return format;
}

DdsFormat extended_format(const TextureFile& file) {
  const auto header = file.part(kHeaderBytes, kExtendedBytes, "the DX10 header");
  const uint32_t code = number_at(header, 0), dimension = number_at(header, 4), misc = number_at(header, 8), images = number_at(header, 12);
  constexpr uint32_t kPremultiplied = 2;
  if ((misc & kExtendedCube) != 0) throw Failure{"is a cube map; expected a two-dimensional texture"};
  if (dimension != kExtended2D) throw Failure{"is a volume or one-dimensional; expected a two-dimensional texture"};
  if (images > 1) throw Failure{"is an array of " + std::to_string(images) + " textures; expected a two-dimensional texture"};
  return {layout_of_dxgi_format(code), "the DXGI format " + std::to_string(code), (number_at(header, 16) & 7) == kPremultiplied,
          kHeaderBytes + kExtendedBytes};
}

DdsFormat format_of(const TextureFile& file, std::span<const std::byte> header) {
  const uint32_t flags = number_at(header, kPixelFlags), code = number_at(header, kFourCc);
  if ((flags & kHasFourCc) == 0) return masked_format(header, flags);
  if (code == four_cc("DX10")) return extended_format(file);
  return {layout_of_four_cc(code), name_of_four_cc(code), code == four_cc("DXT2") || code == four_cc("DXT4")};
}

}  // namespace

Picture read_dds(const ReadRequest& request) {
  const MappedFile mapped(request.file, request.file_bytes);
  const TextureFile file(std::as_bytes(std::span(mapped.data(), mapped.size())), "DDS");
  const auto header = file.part(0, kHeaderBytes, "the header");
  const uint32_t caps = number_at(header, kCaps2);
  if ((caps & kCubeCaps) != 0) throw Failure{"is a cube map; expected a two-dimensional texture"};
  if ((caps & kDepthCaps) != 0 && number_at(header, kDepth) > 1) throw Failure{"is a volume; expected a two-dimensional texture"};
  const DdsFormat format = format_of(file, header);
  if (!format.layout) throw Failure{"has " + format.name + "; expected BC1 to BC7, or uncompressed normalized or floating-point channels"};
  const uint32_t width = number_at(header, kWidth), height = number_at(header, kHeight);
  check_texture_size(request, *format.layout, width, height);
  const auto level = file.part(format.data, level_bytes(*format.layout, width, height), "level 0");
  Picture picture = picture_of_level(*format.layout, level, width, height);
  if (format.premultiplied) divide_by_alpha(picture);
  return picture;
}

}  // namespace halfspace::HS_LANES
