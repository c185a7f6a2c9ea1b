// SPDX-License-Identifier: Apache-2.0
//
// Blend functions that are specialized for a format and, for common blend states, also for the state. Their results are bit-identical to
// those of the general code in blend.cpp.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Blends one color per packet with the existing colors, in the order of the packets. src1: second colors, for dual-source blending.
using BlendProgram = void (*)(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                              const BlendState& state);
/// Blends the color of one packet, which stays in registers. Not for dual-source blending.
using BlendPacketProgram = void (*)(ColorBuffer& buffer, PacketMask packet, const BlendState& state, Real r, Real g, Real b, Real a);

/// The functions for a state. They write all four channels.
struct BlendPrograms {
  BlendProgram batch = nullptr;
  BlendPacketProgram packet = nullptr;
};
/// Returns the functions for a state, or null if there are none for the format.
BlendPrograms blend_programs(ColorFormat format, const BlendState& state);

/// A color buffer into which a fragment kernel blends directly.
struct BlendTarget {
  BlendPacketProgram program = nullptr;
  ColorBuffer* buffer = nullptr;
  const BlendState* state = nullptr;
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
