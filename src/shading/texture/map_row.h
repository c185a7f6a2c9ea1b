// SPDX-License-Identifier: Apache-2.0
//
// Access to adjacent texels of a depth map.
#pragma once

#include <array>

#include "halfspace/core/lane_pairs.h"

namespace halfspace::HS_LANES {

/// Loads texels i, …, i + N − 1 (N up to 4) of row j of a map with `width` columns. Columns outside the map are clamped to the first
/// and the last one. Row j, counted in memory order, must exist.
template <int N, class R>
HS_INLINE std::array<R, N> map_row(const float* map, int width, IntOf<R> i, IntOf<R> j) {
  const IntOf<R> row = j * IntOf<R>(width), first(0), last(width - 1);
  std::array<R, N> texels;
  if (all(i >= first && i <= IntOf<R>(width - 4))) {  // all four texels that gather_row reads are inside the row
    const auto inside = gather_row<N>(map, IntOf<R>(row + i));
    for (std::size_t n = 0; n < N; ++n) texels[n] = R(inside[n]);
  } else {
    for (int n = 0; n < N; ++n)
      texels[static_cast<std::size_t>(n)] = R(gather(map, IntOf<R>(row + min(max(IntOf<R>(i + IntOf<R>(n)), first), last))));
  }
  return texels;
}

}  // namespace halfspace::HS_LANES
