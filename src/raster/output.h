// SPDX-License-Identifier: Apache-2.0
//
// Output merger. In: linear colours of packets. Out: the tile's colour memory: blended, converted to the target's
// format and written where the mask says.
#pragma once

#include "raster/tile.h"

namespace halfspace {

/// Four rows of W floats: r, g, b, a of a packet.
using PacketColor = std::array<Real, 4>;

/// The packet's colours, decoded to linear floats.
PacketColor read_color(const ColorBuffer& buffer, int packet);

/// Writes src where mask says: blended with what is there if blend is given, else replacing it.
void write_color(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& src, const BlendState* blend);

}  // namespace halfspace
