// SPDX-License-Identifier: Apache-2.0
//
// Which pixels have a sample in the box of three corners: of one triangle, or lane by lane.
#pragma once

#include <array>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/pipeline/sample_pattern.h"

namespace halfspace {

template <class T>
HS_INLINE T min_of(const std::array<T, 3>& v) {
  return min(v[0], min(v[1], v[2]));
}
template <class T>
HS_INLINE T max_of(const std::array<T, 3>& v) {
  return max(v[0], max(v[1], v[2]));
}

/// The pixels that may have a sample in the box of the corners (x, y), in 1/256 px. Samples lie at at_x and at_y in their pixel.
template <class I>
HS_INLINE PixelBox<I> pixel_box(const std::array<I, 3>& x, const std::array<I, 3>& y, const SampleSpan& at_x, const SampleSpan& at_y) {
  constexpr int32_t last = kSubPixels - 1;
  // the first pixel with a sample at or right of the least corner; one past the last with a sample at or left of the largest
  const auto first = [](const std::array<I, 3>& v, const SampleSpan& at) { return (min_of(v) + (last - at.high)) >> kSubPixelBits; };
  const auto end = [](const std::array<I, 3>& v, const SampleSpan& at) { return ((max_of(v) - at.low) >> kSubPixelBits) + 1; };
  return {first(x, at_x), first(y, at_y), end(x, at_x), end(y, at_y)};
}

/// The part of a box in bounds.
template <class I>
HS_INLINE PixelBox<I> intersect(const PixelBox<I>& box, const PixelBounds& b) {
  return {max(box.x0, I(b.x0)), max(box.y0, I(b.y0)), min(box.x1, I(b.x1)), min(box.y1, I(b.y1))};
}

/// The pixels that may have a sample in the primitive's box, cut to bounds.
PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& bounds, const SampleSpan& span);
/// Those whose sample at a position lies in it.
PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& bounds, const SamplePosition& at);

}  // namespace halfspace
