// SPDX-License-Identifier: Apache-2.0
//
// Setup. In: a chunk's segments of index lists, and the shaded vertices. Out: Chunk::triangles (culled, clipped where
// needed, wound counter-clockwise, with their depth coefficients), clip vertices and statistics.
#pragma once

#include <optional>

#include "raster/sample_pattern.h"
#include "raster/stages.h"

namespace halfspace {

enum class Cull : uint8_t { none, degenerate, face, no_sample };

/// The triangle of three snapped vertices, or why there is none. flags and vertex of the result are left to the caller
/// but for front, small and provoking; `provoking` is the provoking vertex's place among v.
Cull set_up_triangle(const Draw& draw, const Frame& frame, const std::array<const ScreenVertex*, 3>& v,
                     const std::array<uint32_t, 3>& index, uint32_t provoking, Triangle& out);

/// The pixels that may have a sample in the triangle's box, cut to bounds.
PixelBounds pixel_bounds(const Triangle& t, const PixelBounds& bounds, const SampleSpan& span);
/// Those whose sample at a position lies in it.
PixelBounds pixel_bounds(const Triangle& t, const PixelBounds& bounds, const SamplePosition& at);

/// Fills chunk.triangles from chunk.segments.
void set_up_chunk(const Frame& frame, Chunk& chunk);

}  // namespace halfspace
