// SPDX-License-Identifier: Apache-2.0
//
// The primitives of a frame from the vertex stage to the bins, computed by the pipeline's own functions.
#pragma once

#include <span>
#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// The outcome of primitive setup for a submitted primitive.
enum class StageOutcome : uint8_t {
  kept,        ///< set up without clipping
  clipped,     ///< clipped; the remaining polygon was set up
  outside,     ///< entirely outside one clip plane, or nothing was left after clipping
  face,        ///< culled by CullMode
  degenerate,  ///< no area after snapping
  no_sample,   ///< covers no sample
  non_finite   ///< a position is NaN or infinite
};
inline constexpr std::size_t kStageOutcomes = 7;

/// A submitted primitive.
struct StagePrimitive {
  uint32_t draw, instance, index;  ///< index: number of the primitive in the draw, see PrimitiveId::primitive
  StageOutcome outcome;
  uint32_t first_triangle, triangle_count;  ///< in StageGeometry::triangles
};

struct StageGeometry {
  std::vector<StagePrimitive> primitives;  ///< in submission order
  std::vector<Triangle> triangles;         ///< in submission order; vertex[] is not valid for clipped triangles
  std::vector<uint32_t> primitive_of;      ///< for each triangle, its index in `primitives`
};

/// Returns the primitives of a frame after setup (see visit_set_up_scene).
StageGeometry stage_geometry(const PassContext& context);

/// Returns the three vertex slots of a primitive (see ShadedVertices).
std::array<uint32_t, 3> slots_of(const PassContext& context, const StagePrimitive& primitive);

/// Returns the clip-space positions of the vertices of a primitive, as setup computes them for clipping.
std::array<glm::vec4, 3> clip_positions(const PassContext& context, const StagePrimitive& primitive);

/// Returns true if t covers a sample of a pixel. x and y are window coordinates of the pixel, from the lower left.
bool covers(const PassContext& context, const Draw& draw, const Triangle& t, int x, int y, int sample);

/// Returns the number of pixels in which the triangles of a primitive cover at least one sample.
uint64_t covered_pixels(const PassContext& context, const Draw& draw, std::span<const Triangle> triangles);

/// Returns the number of triangles in the bin of each tile, row by row from the lower left.
std::vector<uint32_t> triangles_per_tile(const PassContext& context);

}  // namespace halfspace
