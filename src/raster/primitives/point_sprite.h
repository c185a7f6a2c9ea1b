// SPDX-License-Identifier: Apache-2.0
//
// Points. In: their positions and sizes, or bounds, from the vertex function. Out: the rectangles that they cover.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// The rectangles of `count` points. clip and extra as in VertexBatch (extra is read where the kernels give a size or bounds).
void make_point_sprites(const Draw& draw, const float* clip, const float* extra, int count, const ScreenVertex* screen,
                        const Outcode* outcodes, PointSpriteRect* out);

}  // namespace halfspace
