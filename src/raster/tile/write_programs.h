// SPDX-License-Identifier: Apache-2.0
//
// Functions that write colors, specialized for a format and, for common blend states, also for the state. Their results are bit-identical
// to those of write_color() (raster/tile/blend.h), which supports all formats.
#pragma once

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Writes the color of one packet, which stays in registers. src1: second color, for dual-source blending; may be null for other states.
using WriteProgram = void (*)(ColorBuffer& buffer, PacketMask packet, const AttachmentState& state, Real r, Real g, Real b, Real a,
                              const PacketColor* src1);
/// Returns the function for a format and a state, or null if there is none for the format.
WriteProgram write_program(ColorFormat format, const AttachmentState& state);

/// A color buffer to which a fragment kernel writes directly. Not for dual-source blending.
struct WriteTarget {
  WriteProgram program = nullptr;
  ColorBuffer* buffer = nullptr;
  AttachmentState state{};

  HS_INLINE void write(PacketMask packet, Real r, Real g, Real b, Real a) const { program(*buffer, packet, state, r, g, b, a, nullptr); }
};

}  // namespace halfspace::HS_LANES
