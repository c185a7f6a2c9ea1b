// SPDX-License-Identifier: Apache-2.0
//
// Inspection of a pass, for programs that visualize the pipeline: traces fragments, measures tiles, and gives access to the results of the
// stages. Not installed.
#pragma once

#include <functional>
#include <vector>

#include "halfspace/raster/loop/tile_worker.h"
#include "halfspace/raster/pass.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/primitives/primitive_stage.h"
#include "halfspace/raster/shade/triangle_attributes.h"
#include "halfspace/raster/trace/fragment_trace.h"

namespace halfspace::HS_LANES {

/// Runs a pass and traces its fragments. Images and statistics are the same as with Pass::run().
PassStatistics run_traced(Pass& pass, const Workers& workers, PassTrace& trace);

/// Runs a pass and measures its tiles. ms receives the time of each tile in milliseconds, row by row from the lower left, summed over all
/// rounds. It is 0 for tiles of a constant color, which are not drawn individually.
PassStatistics run_timed(Pass& pass, const Workers& workers, std::vector<float>& ms);

/// Runs the stages of a pass up to binning and calls visit(context, round) in each round. Does not draw anything.
void visit_set_up(Pass& pass, const Workers& workers, const std::function<void(const PassContext& context, int round)>& visit);

/// A triangle of a pass, and the primitive that it was created from.
struct InspectedTriangle {
  TriangleSource source;
  const Draw* draw;
  uint32_t primitive, instance;          ///< indices of the primitive and the instance in the draw
  std::array<uint32_t, 3> slot;          ///< slots of the submitted vertices; equal to Triangle::vertex if the triangle was not clipped
  std::array<uint32_t, 3> index;         ///< indices of the submitted vertices, without DrawState::base_vertex
  std::array<glm::vec4, 3> position_cs;  ///< clip-space positions of the submitted vertices
};

/// Finds the triangles of a PassContext. The context must outlive the inspector.
class TriangleInspector {
 public:
  explicit TriangleInspector(const PassContext& context);

  /// Finds a triangle. `out` must not be moved or copied, because it contains pointers to itself. It also points to the context.
  void find(TriangleId id, InspectedTriangle& out) const;

 private:
  const PassContext& context_;
  std::vector<std::vector<SubmittedPrimitive>> primitives_;  // for each chunk
};

}  // namespace halfspace::HS_LANES
