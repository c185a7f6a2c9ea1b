// SPDX-License-Identifier: Apache-2.0
//
// Distributes emitted primitives to the layers of the targets and to the viewports of a draw.
#pragma once

#include <vector>

#include "halfspace/raster/amplify/emitted_primitives.h"

namespace halfspace::HS_LANES {

/// Primitives of one layer and one viewport, in order.
struct PrimitivePart {
  int32_t layer = 0, viewport = 0;
  std::vector<uint32_t> indices;
  std::vector<int32_t> numbers, instances;  ///< as in EmittedPrimitives
};

/// What split_primitives() needs to know about a draw and its pass.
struct SplitOptions {
  std::size_t place;       ///< of the layer in a row; the viewport follows
  bool first_provokes;     ///< the first vertex of a primitive determines its layer and viewport; otherwise the last one
  int32_t layers;          ///< of the pass; if there is only one, all primitives are drawn into it
  int32_t viewports;       ///< of the draw
  bool viewports_overlap;  ///< the order of primitives in different viewports matters
};

/// Returns the parts in the order of their first primitives. If viewports overlap, all primitives of a layer are in order; otherwise, each
/// layer has one part per viewport.
std::vector<PrimitivePart> split_primitives(const EmittedPrimitives& primitives, const SplitOptions& options);

}  // namespace halfspace::HS_LANES
