// SPDX-License-Identifier: Apache-2.0
//
// Logic operations on the codes of color buffers (OpenGL 4.6, section 17.3.9). Input: colors of packets. Output: the tile's color buffer.
#pragma once

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Returns true if the operation applies to a format: unsigned normalized values that are not encoded as sRGB, and integers. A tile does
/// not keep the two signed normalized codes for −1 apart.
bool has_logic_op(ColorFormat format);

/// Combines the color with the existing codes, in the lanes in mask and the enabled channels.
void write_logic_op(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& color, LogicOp op, const ColorMask& channels);

}  // namespace halfspace::HS_LANES
