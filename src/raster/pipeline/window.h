// SPDX-License-Identifier: Apache-2.0
//
// Transform from clip space to window coordinates: the minimum w, and snapping to the 1/256 px grid.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// Minimum w of visible points. It keeps 1/w and x/w finite for all |x| ≤ guard·w.
inline constexpr float kMinW = 0x1p-96f;

/// Returns x/w·half + center in 1/256 px, rounded to the nearest integer. Near the guard band, a float quotient can have an error of half a
/// sub-pixel. The remainder of the division and the rounding errors are therefore included, and the result is the same as with exact
/// arithmetic, except for ties within 2^-20 of a sub-pixel. half and center must be multiples of 1/2 px.
HS_INLINE Int snap(Real x, Real w, Real inv_w, float half, float center) {
  const Real half_sub(half * static_cast<float>(kSubPixels));
  const Real center_sub(center * static_cast<float>(kSubPixels));
  const Real quotient = x * inv_w;
  const Real quotient_low = fma(-quotient, w, x) * inv_w;
  const Real scaled = quotient * half_sub;
  const Real scaled_low = fma(quotient, half_sub, -scaled);
  const Real sum = scaled + center_sub;
  const Real back = sum - scaled;
  const Real sum_low = (scaled - (sum - back)) + (center_sub - back);        // Knuth's TwoSum
  const Real whole = clamp(round_even(sum), Real(-0x1p24f), Real(0x1p24f));  // the clamp only matters outside the guard band
  const Real rest = clamp((sum - whole) + (sum_low + fma(quotient_low, half_sub, scaled_low)), Real(-2.0f), Real(2.0f));
  return round_to_int(whole) + round_to_int(rest);
}

/// Returns the window coordinate of an NDC coordinate in 1/256 px, rounded to the nearest integer and clamped to ±2^28. NaN becomes −2^28.
inline int32_t snap(double ndc, float half, float center) {
  const double sub = (ndc * static_cast<double>(half) + static_cast<double>(center)) * kSubPixels;
  return static_cast<int32_t>(std::nearbyint(std::fmin(std::fmax(sub, -0x1p28), 0x1p28)));
}

}  // namespace halfspace
