// SPDX-License-Identifier: Apache-2.0
//
// Functions that write colors, specialized for a format and, for common blend states, also for the state. Their results are bit-identical
// to those of write_color() (raster/tile/blend.h), which supports all formats.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Writes one color per packet, in the order of the packets. src1: second colors, for dual-source blending.
using WriteProgram = void (*)(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                              const AttachmentState& state);
/// Writes the color of one packet, which stays in registers. Not for dual-source blending.
using WritePacketProgram = void (*)(ColorBuffer& buffer, PacketMask packet, const AttachmentState& state, Real r, Real g, Real b, Real a);

struct WritePrograms {
  WriteProgram batch = nullptr;
  WritePacketProgram packet = nullptr;
};
/// Returns the functions for a format and a state. Both are null if there are none for the format.
WritePrograms write_programs(ColorFormat format, const AttachmentState& state);

/// A color buffer to which a fragment kernel writes directly.
struct WriteTarget {
  WritePacketProgram program = nullptr;
  ColorBuffer* buffer = nullptr;
  AttachmentState state{};
};

}  // namespace halfspace::HS_LANES
