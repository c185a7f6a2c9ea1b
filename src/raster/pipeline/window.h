// SPDX-License-Identifier: Apache-2.0
//
// Transform from clip space to window coordinates: the minimum w, and snapping to the 1/256 px grid.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/core/lanes.h"
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

/// Minimum w of visible points. It keeps 1/w and x/w finite for all |x| ≤ guard·w.
inline constexpr float kMinW = 0x1p-96f;

/// Returns x/w·half + center in 1/256 px, rounded to the nearest integer. Near the guard band, a float quotient can have an error of half a
/// sub-pixel. The remainder of the division and the rounding errors are therefore included, and the result is the same as with exact
/// arithmetic, except for ties within 2^-20 of a sub-pixel. half and center must be multiples of 1/512 px
/// below 2^15 px.
template <class R>
HS_INLINE IntOf<R> snap(R x, R w, R inv_w, float half, float center) {
  const R half_sub(half * static_cast<float>(kSubPixels));
  const R center_sub(center * static_cast<float>(kSubPixels));
  const R quotient = x * inv_w;
  const R quotient_low = fma(-quotient, w, x) * inv_w;
  const R scaled = quotient * half_sub;
  const R scaled_low = fma(quotient, half_sub, -scaled);
  const R sum = scaled + center_sub;
  const R back = sum - scaled;
  const R sum_low = (scaled - (sum - back)) + (center_sub - back);  // Knuth's TwoSum
  const R whole = clamp(round_even(sum), R(-0x1p24f), R(0x1p24f));  // the clamp only matters outside the guard band
  const R rest = clamp((sum - whole) + (sum_low + fma(quotient_low, half_sub, scaled_low)), R(-2.0f), R(2.0f));
  return round_to_int(whole) + round_to_int(rest);
}

/// Returns the window coordinate of an NDC coordinate in 1/256 px, rounded to the nearest integer and clamped to ±2^28. NaN becomes −2^28.
inline int32_t snap(double ndc, float half, float center) {
  const double sub = (ndc * static_cast<double>(half) + static_cast<double>(center)) * kSubPixels;
  return static_cast<int32_t>(std::nearbyint(std::fmin(std::fmax(sub, -0x1p28), 0x1p28)));
}

/// A vertex in window coordinates, with its outcode. Use the position only if the outcode has neither kOutGuard nor kOutNonFinite.
template <class R>
struct WindowVertex {
  IntOf<R> x, y;  ///< 1/256 px
  R z, inv_w;
  IntOf<R> outcode;
};

/// Returns the outcode of a clip-space position.
template <class R>
HS_INLINE IntOf<R> outcode(const Viewport& v, const DepthState& depth, R x, R y, R z, R w) {
  const auto bit = [](MaskOf<R> m, Outcode code) { return select(m, IntOf<R>(code), IntOf<R>(0)); };
  const R zero(0.0f);
  const MaskOf<R> finite = (x - x == zero) & (y - y == zero) & (z - z == zero) & (w - w == zero);
  const R z_low = depth.clip == ClipDepth::negative_one_to_one ? -w : zero;
  // fma gives the exact sign of x − guard·w, which the clip stage also computes. If the two stages disagreed about a vertex, one of two
  // adjacent triangles would be clipped at the vertex and the other one would not.
  const MaskOf<R> inside_guard = (fma(w, R(-v.guard_left), x) >= zero) && (fma(w, R(-v.guard_right), x) <= zero) &&
                                 (fma(w, R(-v.guard_bottom), y) >= zero) && (fma(w, R(-v.guard_top), y) <= zero) && (w >= R(kMinW));
  IntOf<R> code = bit(x < -w, kOutLeft) | bit(x > w, kOutRight) | bit(y < -w, kOutBottom) | bit(y > w, kOutTop);
  if (!depth.clamp) code = code | bit(z < z_low, kOutNear) | bit(z > w, kOutFar);
  return code | bit(!inside_guard, kOutGuard) | bit(!finite, kOutNonFinite);
}

/// Transforms a clip-space position to window coordinates.
template <class R>
HS_INLINE WindowVertex<R> window_vertex(const Viewport& v, const DepthState& depth, R x, R y, R z, R w) {
  const R inv_w = R(1.0f) / w;
  // The clamp only matters with depth clamp, where z/w can overflow.
  const R z_window = clamp(fma(z * inv_w, R(v.depth_scale), R(v.depth_bias)), R(-1e30f), R(1e30f));
  return {snap(x, w, inv_w, v.half_width, v.center_x), snap(y, w, inv_w, v.half_height, v.center_y), z_window, inv_w,
          outcode(v, depth, x, y, z, w)};
}

}  // namespace halfspace::HS_LANES
