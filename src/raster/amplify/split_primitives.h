// SPDX-License-Identifier: Apache-2.0
//
// Distributes the primitives or the instances of a draw to the layers of the targets and to its viewports.
#pragma once

#include <optional>
#include <vector>

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

/// Primitives of one layer and one viewport, in order.
struct PrimitivePart {
  Destination to;
  CacheLineVector<uint32_t> indices;
  CacheLineVector<int32_t> numbers, instances;  ///< as in EmittedPrimitives
};

/// What split_primitives() needs to know about a draw and its pass.
struct SplitOptions {
  std::size_t place;       ///< of the layer in a row; the viewport follows
  bool first_provokes;     ///< the first vertex of a primitive determines its layer and viewport; otherwise the last one
  int32_t layers;          ///< of the pass; if there is only one, all primitives are drawn into it
  int32_t viewports;       ///< of the draw
  bool viewports_overlap;  ///< the order of primitives in different viewports matters

  bool is_drawn(const Destination& to) const { return to.layer >= 0 && to.layer < layers && to.viewport >= 0 && to.viewport < viewports; }
};

/// Returns the parts in the order of their first primitives. If viewports overlap, all primitives of a layer are in order; otherwise, each
/// layer has one part per viewport.
std::vector<PrimitivePart> split_primitives(const EmittedPrimitives& primitives, const SplitOptions& options, const Workers& workers);

/// Consecutive instances of a draw whose vertices all have the same layer and viewport.
struct InstanceRun {
  Destination to;
  uint32_t first, count;
};

/// If all vertices of each instance have the same layer and viewport, returns the instances that are drawn, otherwise nothing. layer:
/// kernel with VertexOutput::layer.
std::optional<std::vector<InstanceRun>> split_instances(const Draw& draw, VertexKernel layer, const SplitOptions& options,
                                                        const Workers& workers);

}  // namespace halfspace::HS_LANES
