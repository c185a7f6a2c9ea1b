// SPDX-License-Identifier: Apache-2.0
//
// For programs that show how a pass works: traces its fragments, or hands out what its stages have computed. Not installed. Functions of
// the private folders that such programs need have a counterpart here, because a shared library only exports those of files at the top.
#pragma once

#include <functional>
#include <vector>

#include "halfspace/raster/pass.h"
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "halfspace/raster/primitives/primitive_stage.h"
#include "halfspace/raster/shade/triangle_attributes.h"
#include "halfspace/raster/tile_worker.h"
#include "halfspace/raster/trace/fragment_trace.h"

namespace halfspace {

inline namespace HS_LANES_NAMESPACE {

/// Runs a pass like Pass::run(), with other work in place of the tiles. Calls tiles.run() for each round.
PassStatistics run_with(Pass& pass, TileRunner& tiles, const Workers& workers);

}  // namespace HS_LANES_NAMESPACE

/// Runs a pass and traces its fragments. Images and statistics are the same as with Pass::run().
PassStatistics run_traced(Pass& pass, const Workers& workers, PassTrace& trace);

/// Runs a pass and measures its tiles: ms receives the time of each tile in milliseconds, row by row from the lower left, over all rounds.
/// It is 0 for tiles that are filled together with others because they have a constant color.
PassStatistics run_timed(Pass& pass, const Workers& workers, std::vector<float>& ms);

/// Runs the stages of a pass up to binning and calls visit(context, round) in each round. Nothing is drawn.
void visit_set_up(Pass& pass, const Workers& workers, const std::function<void(const PassContext& context, int round)>& visit);

/// A triangle of a pass, and the primitive that it was created from.
struct InspectedTriangle {
  TriangleSource source;
  const Draw* draw;
  uint32_t primitive, instance;          ///< of the draw
  std::array<uint32_t, 3> slot;          ///< slots of the submitted vertices, as in Triangle::vertex if it was not clipped
  std::array<uint32_t, 3> index;         ///< indices of the submitted vertices, without DrawState::base_vertex
  std::array<glm::vec4, 3> position_cs;  ///< clip-space positions of the submitted vertices
};

/// Finds triangles of a context, which must outlive it.
class TriangleInspector {
 public:
  explicit TriangleInspector(const PassContext& context);

  /// `out` contains pointers to itself and to the context.
  void find(TriangleId id, InspectedTriangle& out) const;

 private:
  const PassContext& context_;
  std::vector<std::vector<SubmittedPrimitive>> primitives_;  // of each chunk
};

}  // namespace halfspace
