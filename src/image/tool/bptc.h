// SPDX-License-Identifier: Apache-2.0
//
// Decodes blocks of BC6H and BC7 (Khronos Data Format Specification 1.3, chapter BPTC). The specification defines all results exactly.
#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Decodes a block of 16 bytes to 16 RGBA texels, in rows of four. A block in the reserved mode gives zeros, also for alpha.
void decode_bc7(const std::byte* block, std::uint8_t* rgba);

/// Decodes a block of 16 bytes to 16 RGB texels, in rows of four. A block in a reserved mode gives zeros. Unsigned values are in [0,
/// 65504]; signed ones can be −∞.
void decode_bc6h(const std::byte* block, bool is_signed, float* rgb);

}  // namespace halfspace::HS_LANES
