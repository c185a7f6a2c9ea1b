// SPDX-License-Identifier: Apache-2.0
//
// Output merger. In: linear colours of packets. Out: the tile's colour memory: blended, converted to the target's
// format and written where the mask says.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// The packet's colours, decoded to linear floats. The buffer's format is not none.
PacketColor read_color(const ColorBuffer& buffer, int packet);

/// The same for several packets, one of out each.
void read_batch(const ColorBuffer& buffer, std::span<const PacketMask> packets, PacketColor* out);

/// Writes the channels that the state names of src where mask says: blended with what is there if the state blends, else
/// replacing it. src1 is the second colour of dual source blending (any, where no factor asks for it).
void write_color(ColorBuffer& buffer, int packet, Mask mask, const PacketColor& src, const PacketColor& src1, const AttachmentState& state);

/// The same for several packets, of which each has one of src and src1.
void write_batch(ColorBuffer& buffer, std::span<const PacketMask> packets, const PacketColor* src, const PacketColor* src1,
                 const AttachmentState& state);

/// Does a factor ask for the second colour?
bool uses_second_source(const BlendState& blend);

}  // namespace halfspace
