// SPDX-License-Identifier: Apache-2.0
//
// From clip space to the window: the smallest w that is drawn, and positions on the grid of 1/256 px.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// Points with a smaller w are clipped. 1/w and x/w stay finite for all |x| ≤ guard·w.
inline constexpr float kMinW = 0x1p-96f;

/// x/w·half + center in 1/256 px, rounded to the nearest whole number. The float quotient alone would err by up to half
/// a sub-pixel near the guard band; its remainder and the rounding of each step are kept, so that the result is that of
/// exact arithmetic but for ties within 2^-20 of a sub-pixel. half and center are multiples of 1/2 px.
HS_INLINE Int snap(Real x, Real w, Real inv_w, float half, float center) {
  const Real half_sub(half * static_cast<float>(kSubPixels));
  const Real center_sub(center * static_cast<float>(kSubPixels));
  const Real quotient = x * inv_w;
  const Real quotient_low = fma(-quotient, w, x) * inv_w;
  const Real scaled = quotient * half_sub;
  const Real scaled_low = fma(quotient, half_sub, -scaled);
  const Real sum = scaled + center_sub;
  const Real back = sum - scaled;
  const Real sum_low = (scaled - (sum - back)) + (center_sub - back);        // Knuth's two-sum
  const Real whole = clamp(round_even(sum), Real(-0x1p24f), Real(0x1p24f));  // only matters beyond the guard band
  const Real rest = clamp((sum - whole) + (sum_low + fma(quotient_low, half_sub, scaled_low)), Real(-2.0f), Real(2.0f));
  return round_to_int(whole) + round_to_int(rest);
}

/// The window coordinate of a normalized device coordinate in 1/256 px, rounded to the nearest integer and clamped to ±2^28. NaN
/// gives −2^28.
inline int32_t snap(double ndc, float half, float center) {
  const double sub = (ndc * static_cast<double>(half) + static_cast<double>(center)) * kSubPixels;
  return static_cast<int32_t>(std::nearbyint(std::fmin(std::fmax(sub, -0x1p28), 0x1p28)));
}

}  // namespace halfspace
