// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/fixed_power.h"
#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

/// Encodes a linear value x in [0, 1] with the sRGB transfer function (IEC 61966-2-1). The result is in [0, 1] and not quantized. For 8-bit
/// values use linear_to_srgb (core/srgb.h), which is exact.
template <Number R>
HS_INLINE R srgb_curve(R x) {
  static constexpr FixedPower power_of(1.0f / 2.4f);
  const R power = fma(R(1.055f), power_of(x), R(-0.055f));
  return min(select(x <= R(0.0031308f), R(12.92f) * x, power), R(1.0f));
}

}  // namespace halfspace::HS_LANES
