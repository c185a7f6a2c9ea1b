// SPDX-License-Identifier: Apache-2.0
//
// How texels are stored in DDS and KTX2 files, and their conversion to a picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "halfspace/image/tool/block_codec.h"
#include "halfspace/image/tool/picture.h"
#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

/// How the bytes of a texel are interpreted. Numbers are little-endian.
enum class TexelStorage : uint8_t {
  masks,   ///< one number; the bits of a channel are an unsigned normalized code
  snorm8,  ///< each channel is a signed normalized code
  snorm16,
  half,  ///< each channel is a float
  single,
  rg11b10,  ///< unsigned floats of 11, 11 and 10 bits, red in the lowest bits
  rgb9e5,   ///< 9-bit mantissas with a common exponent in the highest 5 bits
  blocks
};

struct TextureLayout {
  TexelStorage storage = TexelStorage::masks;
  int bytes = 4;     ///< of a texel or block
  int channels = 4;  ///< not used for masks
  /// The bits of red, green, blue and alpha; 0 for a channel that does not exist. Luminance is in red.
  std::array<uint64_t, 4> masks = {};
  BlockFormat block = BlockFormat::bc1;
};

/// Returns the layout for a DXGI_FORMAT (DDS) or VkFormat (KTX2), or nothing for other formats: integers, depth, video, ETC2, ASTC, PVRTC.
std::optional<TextureLayout> layout_of_dxgi_format(uint32_t format);
std::optional<TextureLayout> layout_of_vk_format(uint32_t format);

TextureLayout block_layout(BlockFormat format);
/// Returns the layout of 1 to 4 channels of the same kind (not masks).
TextureLayout channel_layout(TexelStorage storage, int channels);
TextureLayout mask_layout(int bytes, const std::array<uint64_t, 4>& masks);

/// Throws Failure if a picture of this size exceeds a limit (check_claimed_size).
void check_texture_size(const ReadRequest& request, const TextureLayout& layout, uint32_t width, uint32_t height);

/// Returns the number of bytes of a level. The size must have passed check_texture_size.
std::size_t level_bytes(const TextureLayout& layout, uint32_t width, uint32_t height);

/// Converts a level, whose rows are stored without padding, to a picture. Unsigned codes of up to 8 bits are scaled to 8 bits, wider ones
/// to 16 bits, and all other numbers become floats. A picture with two channels gets a third one, which is 0, unless the second is alpha.
/// `level` has level_bytes() bytes.
Picture picture_of_level(const TextureLayout& layout, std::span<const std::byte> level, uint32_t width, uint32_t height);

}  // namespace halfspace::HS_LANES
