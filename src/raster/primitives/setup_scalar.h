// SPDX-License-Identifier: Apache-2.0
//
// Setup of one triangle. Input: snapped vertices. Output: a Triangle, or the reason why it is culled.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/pipeline/triangle_sizes.h"

namespace halfspace::HS_LANES {

enum class Cull : uint8_t { none, degenerate, face, no_sample };

/// How the facing of a primitive is determined: by its winding, or explicitly. Face culling and polygon offset only apply to by_winding.
enum class Facing : uint8_t { by_winding, front, back };

/// Sets up a triangle from three snapped vertices. Returns the reason if it is culled. index: indices of the vertices, stored in
/// out.vertex; provoking: position of the provoking vertex in v. Only the front-facing, narrow, provoking and covered bits of out.flags
/// are set.
Cull set_up_triangle(const Draw& draw, const PassContext& context, const std::array<const ScreenVertex*, 3>& v,
                     const std::array<uint32_t, 3>& index, uint32_t provoking, Facing facing, Triangle& out);

/// Returns the polygon offset of a polygon that is drawn as an outline or as corners: that of one of its triangles, in window coordinates,
/// whose area must not be 0.
float outline_offset(const DepthOffset& offset, DepthFormat format, const std::array<const ScreenVertex*, 3>& triangle);

}  // namespace halfspace::HS_LANES
