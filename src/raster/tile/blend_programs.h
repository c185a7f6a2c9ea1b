// SPDX-License-Identifier: Apache-2.0
//
// Blend functions that are specialized for a format and, for common blend states, also for the state. They return the same bits as the
// general code in blend.cpp.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// Blends one color per packet with the existing colors, in the order of the packets. src1: second colors, for dual-source blending.
using BlendProgram = void (*)(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                              const BlendState& state);

/// Returns the function for a state, or null if there is none for the format. It writes all four channels.
BlendProgram blend_program(ColorFormat format, const BlendState& state);

}  // namespace halfspace
