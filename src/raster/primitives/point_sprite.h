// SPDX-License-Identifier: Apache-2.0
//
// Points. Input: positions and sizes, or bounds, from the vertex function. Output: the rectangles that the points cover.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Computes the rectangles of `count` points. clip and extra have the layout of VertexBatch; extra is only read if the vertex function sets
/// the size or bounds.
void make_point_sprites(const Draw& draw, const float* clip, const float* extra, int count, const ScreenVertex* screen,
                        const Outcode* outcodes, PointSpriteRect* out);

}  // namespace halfspace::HS_LANES
