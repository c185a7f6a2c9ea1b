// SPDX-License-Identifier: Apache-2.0
//
// Bounding boxes in pixels, of one primitive or of one primitive per lane.
#pragma once

#include <array>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/pipeline/sample_pattern.h"

namespace halfspace::HS_LANES {

template <class T>
HS_INLINE T min_of(const std::array<T, 3>& v) {
  return min(v[0], min(v[1], v[2]));
}
template <class T>
HS_INLINE T max_of(const std::array<T, 3>& v) {
  return max(v[0], max(v[1], v[2]));
}

/// Returns the pixels that may have a sample in the bounding box of three vertices. x and y are in 1/256 px. at_x and at_y are the ranges
/// of sample positions within a pixel.
template <class I>
HS_INLINE PixelBox<I> pixel_box(const std::array<I, 3>& x, const std::array<I, 3>& y, const SampleSpan& at_x, const SampleSpan& at_y) {
  constexpr int32_t last = kSubPixels - 1;
  // `first` is the first pixel with a sample at or after the smallest vertex. `end` is one past the last pixel with a sample at or before
  // the largest vertex.
  const auto first = [](const std::array<I, 3>& v, const SampleSpan& at) { return (min_of(v) + (last - at.high)) >> kSubPixelBits; };
  const auto end = [](const std::array<I, 3>& v, const SampleSpan& at) { return ((max_of(v) - at.low) >> kSubPixelBits) + 1; };
  return {first(x, at_x), first(y, at_y), end(x, at_x), end(y, at_y)};
}

/// Returns the intersection of a box and bounds.
template <class I>
HS_INLINE PixelBox<I> intersect(const PixelBox<I>& box, const PixelBounds& b) {
  return {max(box.x0, I(b.x0)), max(box.y0, I(b.y0)), min(box.x1, I(b.x1)), min(box.y1, I(b.y1))};
}

/// Returns the pixels that may have a sample in the bounding box of a primitive or, for smooth primitives, that may overlap it, clipped to
/// bounds.
PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& bounds, const SampleSpan& span);
/// Returns the pixels whose sample at position `at` is in the bounding box of a primitive, clipped to bounds.
PixelBounds pixel_bounds(const Draw& draw, const Triangle& t, const PixelBounds& bounds, const SamplePosition& at);

}  // namespace halfspace::HS_LANES
