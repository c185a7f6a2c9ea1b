// SPDX-License-Identifier: Apache-2.0
//
// Lines with one sample a pixel, not smoothed (OpenGL 4.6, section 14.5). In: their ends in the window. Out: what they cover.
//
// A line is x-major where |dx| ≥ |dy|, else y-major. In each column (row) it covers the `width` pixels whose centres lie
// within width/2 of it along the shorter axis; which columns is decided by the diamond-exit rule. Where a line or an end lies
// exactly between pixels both ends are taken to be moved by (−ε, −ε²), as the specification has it.
#pragma once

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// A line's width in whole pixels.
int line_pixels(float width);

/// Is the line steeper than the diagonal?
inline bool is_y_major(int64_t dx, int64_t dy) { return (dx < 0 ? -dx : dx) < (dy < 0 ? -dy : dy); }

/// The columns (y-major: rows) that a line from a to b covers.
LineRange line_range(const ScreenVertex& a, const ScreenVertex& b, int pixels);

/// One of the two long sides of a line's band: inside where E + offset − bias ≥ 0.
struct BandEdge {
  Edge edge;
  int64_t offset;
  int32_t bias;
};
std::array<BandEdge, 2> band_edges(const Triangle& line, int pixels);

/// The pixels that may be covered, cut to bounds.
PixelBounds line_bounds(const Triangle& line, int pixels, const PixelBounds& bounds);

}  // namespace halfspace
