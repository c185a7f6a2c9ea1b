// SPDX-License-Identifier: Apache-2.0
//
// Results of the fragment function for packed pixels.
#pragma once

#include "halfspace/raster/shade/fragment_batch.h"
#include "halfspace/raster/visibility/sink/packed_pixels.h"

namespace halfspace::HS_LANES {

struct PackedFragments {
  PackedPixels pixels;
  FragmentOutput output;  ///< indexed like the pixels
};

/// Moves the results for packets.size() ≤ kPacketBatch packets back to their lanes. first: number of the first pixel of these packets.
/// Returns the number of the pixel after the last.
std::size_t unpack(const ShaderKernels& kernels, const FragmentOutput& packed, std::size_t first, std::span<const PacketMask> packets,
                   FragmentOutput& out);

/// Writes the colors of packed pixels to the packets to which they belong. packed: the output of a batch with `pixels`.
void write_packed(const FragmentOutput& packed, std::span<const PacketMask> packets, const WriteTarget& to);

}  // namespace halfspace::HS_LANES
