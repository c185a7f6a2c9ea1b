// SPDX-License-Identifier: Apache-2.0
//
// Vertex stage. In: a draw's streams and the indices it uses. Out: ShadedVertices: window positions snapped to
// 1/256 px, outcodes and varyings, each used vertex once.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// The transform of a draw's clip space to the window. viewport in pixels; depth range as in DepthState.
Viewport make_viewport(const Rect& viewport, const DepthState& depth);

/// Shades vertices [begin, end) of the list of vertices that the draw's indices use, instance after instance. Gives the union of
/// their outcodes.
Outcode shade_vertices(const Draw& draw, std::size_t begin, std::size_t end, ShadedVertices& out);

/// Allocates out for all the vertices that the draw uses.
void allocate_vertices(const Draw& draw, ShadedVertices& out);

}  // namespace halfspace
