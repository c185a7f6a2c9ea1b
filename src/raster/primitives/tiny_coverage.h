// SPDX-License-Identifier: Apache-2.0
//
// Coverage of tiny triangles. Setup uses it to find the pixels of a triangle and to cull triangles that cover no sample, which saves the
// cost of binning and rasterizing them. More than half of all triangles with an area of half a pixel cover no sample.
#pragma once

#include <array>
#include <bit>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_sizes.h"

namespace halfspace::HS_LANES {

/// Returns the pixels of the box whose centers are covered by the triangle: bit kTinySide·r + c is pixel c of row r. If the box has more
/// than kTinySide rows or columns, only the first kTinySide are tested. R: float, or Real for one triangle per lane. x, y: vertices in
/// 1/256 px, counter-clockwise, with an extent of at most kNarrowExtent.
template <class R>
HS_INLINE IntOf<R> covered_centers(const std::array<IntOf<R>, 3>& x, const std::array<IntOf<R>, 3>& y, const PixelBox<IntOf<R>>& box) {
  using I = IntOf<R>;
  constexpr int32_t center = kSubPixels / 2;
  std::array<I, 3> row, step_x, step_y;  // edge functions minus the bias of the fill rule (raster/pipeline/edge.h)
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    const I ex = x[b] - x[a], ey = y[b] - y[a];
    row[i] = ex * ((box.y0 << kSubPixelBits) + center - y[a]) - ey * ((box.x0 << kSubPixelBits) + center - x[a]) - fill_bias(ex, ey);
    step_x[i] = -ey << kSubPixelBits;
    step_y[i] = ex << kSubPixelBits;
  }
  I covered(0);
  for (int32_t r = 0; r < kTinySide && any(box.y0 + r < box.y1); ++r) {
    std::array<I, 3> e = row;
    for (int32_t c = 0; c < kTinySide && any(box.x0 + c < box.x1); ++c) {
      const MaskOf<R> is_covered = (e[0] | e[1] | e[2]) >= I(0) && box.y0 + r < box.y1 && box.x0 + c < box.x1;
      covered = covered | select(is_covered, I(1 << (kTinySide * r + c)), I(0));
      for (std::size_t i = 0; i < 3; ++i) e[i] = e[i] + step_x[i];
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] = row[i] + step_y[i];
  }
  return covered;
}

/// Returns the flags of a triangle for Triangle::covered, or 0 if the box is too large. centers: result of covered_centers().
template <class I>
HS_INLINE I covered_flags(const PixelBox<I>& box, I centers) {
  static_assert(std::popcount(kCoveredBits) == kTinySide * kTinyRows);
  return select(box.fits_in(kTinySide, kTinyRows), centers << static_cast<int>(kCoveredShift), I(0));
}

}  // namespace halfspace::HS_LANES
