// SPDX-License-Identifier: Apache-2.0
//
// One primitive's setup. In: snapped vertices. Out: a Triangle, or why there is none.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// Largest extent at which every edge function fits in int32 without a shift anywhere in a tile that the triangle meets:
/// at most (63 + 64)·256 < 2^15 sub-pixels from a vertex, times an edge of at most 63·256 < 2^14, twice: below 2^30.
inline constexpr int32_t kSmallExtent = 63 * kSubPixels;

enum class Cull : uint8_t { none, degenerate, face, no_sample };

/// Which way a primitive faces: by its winding, and is then culled by it and offset in depth; or as is said.
enum class Facing : uint8_t { by_winding, front, back };

/// The triangle of three snapped vertices, or why there is none. flags and vertex of the result are left to the caller
/// but for front, small and provoking; `provoking` is the provoking vertex's place among v.
Cull set_up_triangle(const Draw& draw, const PassContext& context, const std::array<const ScreenVertex*, 3>& v,
                     const std::array<uint32_t, 3>& index, uint32_t provoking, Facing facing, Triangle& out);

/// The line of two (with one sample a pixel).
Cull set_up_line(const Draw& draw, const PassContext& context, const std::array<const ScreenVertex*, 2>& v,
                 const std::array<uint32_t, 2>& index, uint32_t provoking, Facing facing, Triangle& out);

/// The corners of the rectangle that a line is with several samples a pixel, counter-clockwise: right of a, right of b, left of b, left of
/// a, seen along the line. The ends differ.
std::array<ScreenVertex, 4> line_rectangle(const ScreenVertex& a, const ScreenVertex& b, float width);

}  // namespace halfspace
