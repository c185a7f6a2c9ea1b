// SPDX-License-Identifier: Apache-2.0
//
// Sizes and limits of the work of a pass. The defaults suit all scenes that were measured. Tests set other values to reach rare cases.
#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Affects speed and memory use only, except that bin_budget can change the result of order-independent blending
/// (DrawState::order_independent) and contents that are not defined (LoadOp::dont_care).
struct PassTuning {
  /// Maximum tile size: 8, 16, 32 or 64 pixels. Smaller tiles are used if multiple samples or attachments need the memory.
  int tile_size = 64;
  /// Maximum number of primitives per setup task: 1 to 8192.
  uint32_t chunk_triangles = 8192;
  /// Size limit in bytes, for triangles with their bins and for shaded vertices. When one of them reaches it, the tiles are rendered before
  /// more triangles are set up. The vertices of a single draw can exceed it.
  std::size_t bin_budget = 1 << 28;
  /// If false, all fragments are shaded immediately, in submission order.
  bool defer = true;
};

}  // namespace halfspace::HS_LANES
