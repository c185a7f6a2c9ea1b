// SPDX-License-Identifier: Apache-2.0
//
// The primitives of a frame on their way from the vertex stage to the bins, computed by the functions of the pipeline itself.
#pragma once

#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// What became of a submitted primitive.
enum class StageOutcome : uint8_t {
  kept,        ///< set up as it is
  clipped,     ///< cut by a clip plane; what is left was set up
  outside,     ///< outside one plane of the view volume, or nothing left after clipping
  face,        ///< culled by CullMode
  degenerate,  ///< no area after snapping
  no_sample,   ///< contains no sample
  non_finite   ///< a position is NaN or infinite
};
inline constexpr std::size_t kStageOutcomes = 7;

/// A submitted primitive.
struct StagePrimitive {
  uint32_t draw, instance, index;  ///< index: in the draw, as PrimitiveId::primitive
  StageOutcome outcome;
  uint32_t first_triangle, triangle_count;  ///< in StageGeometry::triangles
};

struct StageGeometry {
  std::vector<StagePrimitive> primitives;  ///< in submission order
  std::vector<Triangle> triangles;         ///< in submission order. The vertex[] of clipped ones are meaningless.
  std::vector<uint32_t> primitive_of;      ///< of each triangle
};

/// Lists the primitives of a set-up frame (see visit_set_up_scene).
StageGeometry stage_geometry(const PassContext& context);

/// Returns the three vertex slots of a primitive (see ShadedVertices).
std::array<uint32_t, 3> slots_of(const PassContext& context, const StagePrimitive& primitive);

/// Returns the clip-space positions of the vertices of a primitive, as setup computes them for clipping.
std::array<glm::vec4, 3> clip_positions(const PassContext& context, const StagePrimitive& primitive);

/// Returns true if a primitive after setup covers a sample. x and y are pixels in window coordinates (origin at the lower left).
bool covers(const PassContext& context, const Draw& draw, const Triangle& t, int x, int y, int sample);

/// Returns the number of pixels with at least one covered sample.
uint64_t covered_pixels(const PassContext& context, const Draw& draw, const Triangle& t);

/// Returns the number of triangles in the bin of each tile, row by row from the lower left.
std::vector<uint32_t> triangles_per_tile(const PassContext& context);

}  // namespace halfspace
