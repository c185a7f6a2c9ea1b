// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/tile.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

void refresh_hiz(Tile& tile, int block) {
  const float* depth = &tile.depth[static_cast<std::size_t>(block) * kPixelsPerBlock];
  Real low = load<Real>(depth), high = low;
  for (int p = 1; p < kPacketsPerBlock; ++p) {
    const Real z = load<Real>(depth + p * kLanes);
    low = min(low, z);
    high = max(high, z);
  }
  // Reduce by halves: minimum and maximum do not depend on the order.
  alignas(64) std::array<float, kLanes> lows, highs;
  store(lows.data(), low);
  store(highs.data(), high);
  for (std::size_t half = kLanes / 2; half != 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) {
      lows[i] = min(lows[i], lows[i + half]);
      highs[i] = max(highs[i], highs[i + half]);
    }
  }
  const auto b = static_cast<std::size_t>(block);
  tile.hiz_min[b] = lows[0];
  tile.hiz_max[b] = highs[0];
  tile.hiz_writes[b] = 0;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
