// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/shade/plane_anchor.h"

#include <algorithm>
#include <cmath>

#include "halfspace/raster/primitives/setup_scalar.h"

namespace halfspace::HS_LANES {

namespace {

static_assert(PlaneCell::kSize % kMaxTileSize == 0, "a tile must not be in two cells");

struct Span {
  int64_t low, high;

  int64_t middle() const { return (low + high) >> 1; }
  int64_t reach() const { return high - middle(); }  ///< largest distance from the middle
};

// Returns the part of [low, high] in the cell that starts at a pixel. low > high if there is none.
Span part_in_cell(int64_t low, int64_t high, int cell) {
  const int64_t begin = int64_t{cell} * kSubPixels;
  return {std::max(low, begin), std::min(high, begin + PlaneCell::kSize * kSubPixels)};
}

// The error bound divided by u·M, minus 2; see the header.
double corner_error(double b, double b_x, double b_y, const Span& x, const Span& y) {
  return std::fabs(1.0 - 2.0 * b) + 2.0 * std::fabs(b_x) * static_cast<double>(x.reach()) +
         4.0 * std::fabs(b_y) * static_cast<double>(y.reach());
}

}  // namespace

PlaneAnchor plane_anchor(const std::array<PlaneCorner, 3>& corner, const PlaneCell& cell) {
  const PlaneCorner &v0 = corner[0], &v1 = corner[1], &v2 = corner[2];
  if (v0.inv_w != v1.inv_w || v0.inv_w != v2.inv_w) return {};
  const auto [left, right] = std::minmax({v0.x, v1.x, v2.x});
  const auto [bottom, top] = std::minmax({v0.y, v1.y, v2.y});
  if (right - left <= kNarrowExtent && top - bottom <= kNarrowExtent) return {};
  const Span x = part_in_cell(left, right, cell.x), y = part_in_cell(bottom, top, cell.y);
  if (x.low > x.high || y.low > y.high) return {};
  const auto real = [](int64_t i) { return static_cast<double>(i); };
  const int64_t e1x = v1.x - v0.x, e1y = v1.y - v0.y, e2x = v2.x - v0.x, e2y = v2.y - v0.y;
  const int64_t dx = x.middle() - v0.x, dy = y.middle() - v0.y;
  const double per_area = 1.0 / real(e1x * e2y - e1y * e2x);
  PlaneAnchor a{.is_valid = true,
                .x = x.middle(),
                .y = y.middle(),
                .b1 = real(dx * e2y - dy * e2x) * per_area,
                .b2 = real(e1x * dy - e1y * dx) * per_area,
                .b1_x = real(e2y) * per_area,
                .b1_y = real(-e2x) * per_area,
                .b2_x = real(-e1y) * per_area,
                .b2_y = real(e1x) * per_area};
  constexpr double max_error = 3.0;
  a.is_valid = corner_error(a.b1, a.b1_x, a.b1_y, x, y) <= max_error && corner_error(a.b2, a.b2_x, a.b2_y, x, y) <= max_error &&
               corner_error(1.0 - (a.b1 + a.b2), a.b1_x + a.b2_x, a.b1_y + a.b2_y, x, y) <= max_error;
  return a;
}

}  // namespace halfspace::HS_LANES
