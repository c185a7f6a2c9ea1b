// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/fixed_power.h"
#include "halfspace/core/lane_math.h"

namespace halfspace {

/// Encodes a linear value x in [0, 1] by the sRGB curve (IEC 61966-2-1); the result is a number in [0, 1] and not rounded to a code.
/// Where 8-bit codes are wanted, linear_to_srgb (core/srgb.h) is exact.
template <Number R>
HS_INLINE R srgb_curve(R x) {
  static constexpr FixedPower power_of(1.0f / 2.4f);
  const R power = fma(R(1.055f), power_of(x), R(-0.055f));
  return min(select(x <= R(0.0031308f), R(12.92f) * x, power), R(1.0f));
}

}  // namespace halfspace
