// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/tile.h"

#include "halfspace/core/lane_reduce.h"

namespace halfspace::HS_LANES {

void refresh_hiz(Tile& tile, int block) {
  const float* depth = &tile.depth[static_cast<std::size_t>(block) * kPixelsPerBlock];
  std::array<Real, kPacketsPerBlock> low, high;
  for (std::size_t p = 0; p < kPacketsPerBlock; ++p) low[p] = high[p] = load<Real>(depth + p * kLanes);
  // In pairs, because a chain of dependent operations would take several times as long.
  for (std::size_t half = kPacketsPerBlock / 2; half != 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) {
      low[i] = min(low[i], low[i + half]);
      high[i] = max(high[i], high[i + half]);
    }
  }
  const auto b = static_cast<std::size_t>(block);
  tile.hiz_min[b] = min_lane(low[0]);
  tile.hiz_max[b] = max_lane(high[0]);
  tile.hiz_is_stale[b] = false;
}

}  // namespace halfspace::HS_LANES
