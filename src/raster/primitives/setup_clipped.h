// SPDX-License-Identifier: Apache-2.0
//
// Setup of clipped primitives. Input: the vertex slots of a triangle or line. Output: its pieces in Chunk::triangles, and the vertices of
// the pieces in Chunk::clip_vertices.
#pragma once

#include "halfspace/raster/primitives/clip.h"
#include "halfspace/raster/primitives/setup_range.h"

namespace halfspace::HS_LANES {

using ClipFunction = ClipPolygon (*)(const Viewport&, const DepthState&, const std::array<glm::vec4, 3>&, const ClipDistances&);

/// Clips a primitive with clip_triangle() or clip_line(), and appends the pieces: triangles, lines or points, depending on the topology and
/// the polygon mode. is_cut: the primitive needs clipping. (A primitive that needs none can be passed to get its clip vertices.)
void set_up_clipped(SetupRange& range, const PrimitiveSlots& slots, ClipFunction clip, bool is_cut);

}  // namespace halfspace::HS_LANES
