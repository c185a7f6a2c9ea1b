// SPDX-License-Identifier: Apache-2.0
//
// Which pixels small triangles cover, and which triangles fall between the samples. Of small triangles many do (of half a pixel's area more
// than half), and what is dropped in setup costs no bin and no tile anything.
#pragma once

#include <array>
#include <bit>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pixel_box.h"

namespace halfspace {

/// Boxes of at most so many pixels a side are asked sample by sample.
inline constexpr int kCoverSide = 4;

/// Whose centres a triangle covers of the pixels of the box: bit kCoverSide·r + c for pixel c of row r. Lane by lane; R: float or Real. x,
/// y: its corners in 1/256 px, counter-clockwise, at most kSmallExtent from each other. Of a box of more than kCoverSide pixels a side only
/// the first ones are told.
template <class R>
HS_INLINE IntOf<R> covered_centers(const std::array<IntOf<R>, 3>& x, const std::array<IntOf<R>, 3>& y, const PixelBox<IntOf<R>>& box) {
  using I = IntOf<R>;
  constexpr int32_t center = kSubPixels / 2;
  std::array<I, 3> row, step_x, step_y;  // the edge functions less the fill rule's bias (raster/pipeline/edge.h)
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    const I ex = x[b] - x[a], ey = y[b] - y[a];
    row[i] = ex * ((box.y0 << kSubPixelBits) + center - y[a]) - ey * ((box.x0 << kSubPixelBits) + center - x[a]) - fill_bias(ex, ey);
    step_x[i] = -ey << kSubPixelBits;
    step_y[i] = ex << kSubPixelBits;
  }
  I covered(0);
  for (int32_t r = 0; r < kCoverSide && any(box.y0 + r < box.y1); ++r) {
    std::array<I, 3> e = row;
    for (int32_t c = 0; c < kCoverSide && any(box.x0 + c < box.x1); ++c) {
      const MaskOf<R> is_covered = (e[0] | e[1] | e[2]) >= I(0) && box.y0 + r < box.y1 && box.x0 + c < box.x1;
      covered = covered | select(is_covered, I(1 << (kCoverSide * r + c)), I(0));
      for (std::size_t i = 0; i < 3; ++i) e[i] = e[i] + step_x[i];
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] = row[i] + step_y[i];
  }
  return covered;
}

/// Those of a triangle as its flags hold them (Triangle::covered). centers: its covered_centers.
template <class I>
HS_INLINE I covered_flags(const PixelBox<I>& box, I centers) {
  constexpr int32_t rows = std::popcount(kCoveredBits) / kCoverSide;
  return select(box.fits_in(kCoverSide, rows), centers << static_cast<int>(kCoveredShift), I(0));
}

}  // namespace halfspace
