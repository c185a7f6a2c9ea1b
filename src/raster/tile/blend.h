// SPDX-License-Identifier: Apache-2.0
//
// Output merger. Input: linear colors of packets. Output: the tile's color buffers. Colors are blended, converted to the format of the
// attachment and written where the mask is set.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Returns the colors of a packet as linear floats. The format of the buffer must not be none.
PacketColor read_color(const ColorBuffer& buffer, int packet);

/// The same for several packets. out has one element for each.
void read_batch(const ColorBuffer& buffer, std::span<const PacketMask> packets, PacketColor* out);

/// Writes the channels of src that the state enables to the lanes in mask. If the state has a BlendState, colors are blended with the
/// existing ones; otherwise they replace them. src1 is the second color for dual-source blending; only src1 factors read it.
void write_color(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& src, const PacketColor& src1, const AttachmentState& state);

/// The same for several packets. src and src1 have one element for each. Uses the functions of write_programs.h for the formats that have
/// them; write_color() defines their results (test Blend.ProgramsWriteTheSameBitsAsTheGeneralCode).
void write_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                 const AttachmentState& state);

/// Returns true if a blend factor refers to the second color.
bool uses_second_source(const BlendState& blend);

}  // namespace halfspace::HS_LANES
