// SPDX-License-Identifier: Apache-2.0
//
// Aliased lines for passes with one sample per pixel (OpenGL 4.6, section 14.5). Input: end points in window coordinates. Output: the
// covered pixels.
//
// A line is x-major if |dx| ≥ |dy|, otherwise y-major. In each column (y-major: row), it covers the `width` pixels whose centers are within
// width/2 of the line along the minor axis. The diamond-exit rule determines the columns. Both end points are treated as if moved by (−ε,
// −ε²), as in the specification; this decides the cases in which the line or an end point is exactly between pixels.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

/// Returns the width of a line, rounded to an integer number of pixels from 1 to 4096.
inline int line_pixels(float width) { return width <= 1.0f ? 1 : static_cast<int>(std::nearbyint(std::min(width, 4096.0f))); }

/// Returns true if the line is y-major.
inline bool is_y_major(int64_t dx, int64_t dy) { return (dx < 0 ? -dx : dx) < (dy < 0 ? -dy : dy); }

/// Returns the columns (y-major: rows) that a line from a to b covers. `pixels` is its width from line_pixels().
LineRange line_range(const ScreenVertex& a, const ScreenVertex& b, int pixels);

/// One of the two long sides of a line. A sample is inside if E + offset − bias ≥ 0.
struct BandEdge {
  Edge edge;
  int64_t offset;
  int32_t bias;
};
std::array<BandEdge, 2> band_edges(const Triangle& line, int pixels);

/// Returns a conservative bounding box of the covered pixels, clipped to bounds.
PixelBounds line_bounds(const Triangle& line, int pixels, const PixelBounds& bounds);

}  // namespace halfspace::HS_LANES
