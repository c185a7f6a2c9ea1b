// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/relief_detail.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

namespace {

Image<float> halved(const Image<float>& map, const Workers& workers) {
  Image<float> out(std::max(1, map.width() / 2), std::max(1, map.height() / 2));
  workers.for_each(out.height(), [&](int y) {
    const int y1 = std::min(2 * y + 1, map.height() - 1);
    for (int x = 0; x < out.width(); ++x) {
      const int x1 = std::min(2 * x + 1, map.width() - 1);
      out.at(x, y) = 0.25f * ((map.at(2 * x, 2 * y) + map.at(x1, 2 * y)) + (map.at(2 * x, y1) + map.at(x1, y1)));
    }
  });
  return out;
}

// Returns the 99.9th percentile of the absolute difference between a map and its half, interpolated bilinearly.
double lost(const Image<float>& map, const Image<float>& half, const Workers& workers) {
  std::vector<float> differences(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
  workers.for_each(map.height(), [&](int y) {
    // `half` has half the resolution: a texel center is a quarter of a `half` texel away from the nearest center of `half`.
    const int near_y = std::min(y / 2, half.height() - 1), far_y = std::clamp(near_y + (y % 2 == 0 ? -1 : 1), 0, half.height() - 1);
    for (int x = 0; x < map.width(); ++x) {
      const int near_x = std::min(x / 2, half.width() - 1), far_x = std::clamp(near_x + (x % 2 == 0 ? -1 : 1), 0, half.width() - 1);
      const float a = 0.75f * half.at(near_x, near_y) + 0.25f * half.at(far_x, near_y);
      const float b = 0.75f * half.at(near_x, far_y) + 0.25f * half.at(far_x, far_y);
      differences[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width()) + static_cast<std::size_t>(x)] =
          std::fabs(map.at(x, y) - (0.75f * a + 0.25f * b));
    }
  });
  const auto nth = differences.begin() + static_cast<std::ptrdiff_t>((differences.size() - 1) * 999 / 1000);
  std::ranges::nth_element(differences, nth);
  return static_cast<double>(*nth);
}

}  // namespace

ReliefDetail::ReliefDetail(const Image<float>& map, double smoothing, const Workers& workers) {
  levels_.push_back({static_cast<double>(map.width()), 0.0});  // replaced below, once the error of the first halving is known
  // A Gaussian with standard deviation σ scales a wave of length λ by exp(−2π²σ²/λ²). The B-spline of the height field acts like
  // another Gaussian with σ² = 1/3. A halving removes waves of 2 to 4 texels; the longest of them are attenuated least.
  const double sigma_squared = smoothing * smoothing + 1.0 / 3.0;
  double wave = 4.0, error = 0.0;
  Image<float> kept;
  for (const Image<float>* fine = &map; fine->width() >= 4; wave *= 2.0) {
    Image<float> half = halved(*fine, workers);
    const double exponent = -2.0 * std::numbers::pi * std::numbers::pi * sigma_squared / (wave * wave);
    error += static_cast<double>(exp(static_cast<float>(exponent))) * lost(*fine, half, workers);
    levels_.push_back({static_cast<double>(half.width()), error});
    kept = std::move(half);
    fine = &kept;
  }
  // With one vertex per texel, nothing is averaged away. The remaining chord error decreases by a factor of four when the number of columns
  // doubles.
  if (levels_.size() > 1) levels_.front().error = 0.25 * levels_[1].error;
}

double ReliefDetail::error(double columns) const {
  if (columns >= levels_.front().columns) {
    const double finer = levels_.front().columns / columns;
    return levels_.front().error * finer * finer;
  }
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level &finer = levels_[i - 1], &coarser = levels_[i];
    if (columns < coarser.columns) continue;
    const double t = (finer.columns - columns) / (finer.columns - coarser.columns);
    return finer.error + t * (coarser.error - finer.error);
  }
  return levels_.back().error;
}

}  // namespace halfspace::HS_LANES
