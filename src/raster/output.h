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
PacketColor read_color(const Tile& tile, int packet);

/// Writes src where mask says: blended with what is there if blend is given, else replacing it.
void write_color(Tile& tile, int packet, Mask mask, const PacketColor& src, const BlendState* blend);

/// A colour as one pixel of the format, for clears: 4, 8 or 16 bytes.
std::array<std::byte, 16> encode_pixel(ColorFormat format, const glm::vec4& color);

}  // namespace halfspace
