// SPDX-License-Identifier: Apache-2.0
//
// Points. In: their positions and sizes, or bounds, from the vertex function. Out: the rectangles that they cover.
#pragma once

#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// The rectangles of `count` points. clip and extra as in VertexBatch (extra is read where the kernels give a size or bounds).
void make_sprites(const Draw& draw, const float* clip, const float* extra, int count, const ScreenVertex* screen, const Outcode* outcodes,
                  SpriteRect* out);

/// The triangle that interpolates over a sprite: its corners in the window, all as deep and as far as the point. From the first
/// corner to the second the point coordinate's s grows from 0 to 1, from the first to the third t.
std::array<ScreenVertex, 3> sprite_corners(const Triangle& sprite, const ScreenVertex& point, PointOrigin origin);

}  // namespace halfspace
