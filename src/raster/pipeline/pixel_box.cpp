// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pixel_box.h"

#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/smooth_area.h"

namespace halfspace::HS_LANES {

namespace {

PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& b, const SampleSpan& at_x, const SampleSpan& at_y) {
  if (draw.is_smooth) return SmoothArea(draw, t).pixels(b);
  if (t.is_line()) return line_bounds(t, line_pixels(draw.state.line_width), b);
  return intersect(pixel_box(t.x, t.y, at_x, at_y), b);
}

}  // namespace

PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& b, const SampleSpan& span) {
  return pixel_bounds(draw, t, b, span, span);
}

PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& b, const SamplePosition& at) {
  return pixel_bounds(draw, t, b, {at.x, at.x}, {at.y, at.y});
}

}  // namespace halfspace::HS_LANES
