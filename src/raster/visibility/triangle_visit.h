// SPDX-License-Identifier: Apache-2.0
//
// Data of the general rasterizer (visibility_general.cpp).
#pragma once

#include <array>

#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Packets of one triangle that wait for the visibility function.
struct PendingPackets {
  int count = 0;
  std::array<PacketMask, kPacketBatch> packets;  ///< lanes: the covered ones
  /// Depth of the triangle; replaced by the shader's depth if it writes depth.
  alignas(64) std::array<Real, kPacketBatch> depth;
};

/// Values that all packets of a triangle share, for draws that are not opaque.
template <class S>
struct TriangleVisit {
  using Statistics = S;

  const PassContext& context;
  const Draw& draw;
  const Triangle& triangle;
  TriangleId id;
  VisibilityMode mode;
  Tile& tile;
  CoverageList* list;
  Statistics& statistics;
  const StencilFace* stencil;     ///< null: no stencil test before shading
  bool tests;                     ///< depth is tested, before or after shading
  bool writes;                    ///< the depth test writes depth
  bool runs_visibility_function;  ///< the shader's visibility function must be called
  bool rejects_blocks;            ///< skip blocks in which no depth can pass
  bool is_slow;                   ///< the shader or the stencil test determines visibility
  bool needs_bounds_test;         ///< covered pixels can be outside the bounds of the primitive
  PendingPackets& pending;        ///< packets for the visibility function
  SampleGrid grid;                ///< the current sample
  const DrawInTile& draw_in_tile;
  float low = 0.0f, high = 1.0f;  ///< bounds of the triangle's depth
};

}  // namespace halfspace::HS_LANES
