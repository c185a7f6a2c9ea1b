// SPDX-License-Identifier: Apache-2.0
//
// Decodes textures that are compressed in blocks of 4x4 texels: BC1 to BC3 (S3TC), BC4 and BC5 (RGTC), BC6H and BC7 (BPTC). The formulas
// are those of the Khronos Data Format Specification 1.3, which defines the values of BC1 to BC5 as fractions: they are rounded once, to
// the nearest value of the sample type. (Readers of OpenImageIO differ between versions and round BC4 and BC5 to 8 bits.)
#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

enum class BlockFormat : uint8_t { bc1_opaque, bc1, bc2, bc3, bc4, bc4_signed, bc5, bc5_signed, bc6h, bc6h_signed, bc7 };

/// Number of texels per side of a block.
inline constexpr int kBlockEdge = 4;

struct BlockInfo {
  int bytes;     ///< of a block
  int channels;  ///< of a decoded texel: red; red, green and blue; or RGBA. The blue of BC5 is 0.
  Sample sample;
};

/// BC4 and BC5 have more than 8 bits of precision. BC6H and signed formats contain numbers instead of codes.
BlockInfo block_info(BlockFormat format);

/// Decodes a block to 16 texels, in rows of four, without padding.
void decode_block(BlockFormat format, const std::byte* block, std::byte* texels);

}  // namespace halfspace::HS_LANES
