// SPDX-License-Identifier: Apache-2.0
//
// Packets for the kernels that call a shader's fragment or visibility function.
#pragma once

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

struct PassContext;

/// Maximum number of packets per call of a kernel, unless stated otherwise. It is even, because packets are shaded in pairs.
inline constexpr int kPacketBatch = 16;

/// Packets of one draw.
struct PacketBatch {
  const PassContext* context = nullptr;
  int tile_x0 = 0, tile_y0 = 0;            ///< window coordinates of pixel (0, 0) of the tile's storage
  SamplePosition position = kPixelCenter;  ///< position within the pixel at which the shader is evaluated
  int sample = 0;                          ///< number of the sample at this position, if the shader runs per sample
  const TriangleId* ids = nullptr;         ///< triangle of each pixel of the tile; null if each packet shows only one, see packet_ids
  const TriangleId* packet_ids = nullptr;  ///< triangle of each packet; only used if ids is null
  const PacketMask* packets = nullptr;
  int count = 0;                              ///< ≤ kPacketBatch for a fragment function, unless FragmentBatch::codes or target is set
  const SamplePosition* centroids = nullptr;  ///< positions of centroid varyings, W for each packet; null if the same as position
  /// If not null, the pixels are packed (see PackedPixels): packet i contains pixels i·W to i·W + W − 1 of this list. Each is stored as
  /// (y << 16) | x relative to the tile, and `ids` has the same order.
  const int32_t* pixels = nullptr;
};

/// Packets for a shader's visibility function.
struct VisibilityBatch : PacketBatch {
  uint16_t* keep;  ///< receives the lanes that the shader keeps, one bit per lane, for each packet
  /// Receives the depth, if the shader writes it. px.z() has the same value as in the fragment function, so both functions return the same
  /// depth.
  Real* depth;
};

}  // namespace halfspace::HS_LANES
