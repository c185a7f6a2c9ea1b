// SPDX-License-Identifier: Apache-2.0
//
// How far texels that both renderers round may be apart.
#pragma once

#include <algorithm>
#include <cmath>

#include "halfspace/core/texel_format.h"

namespace halfspace::test {

/// Returns the allowed difference of a channel: a code, since both round what they interpolate.
inline double texel_tolerance(TexelFormat format, int channel, double value) {
  const TexelInfo& info = texel_info(format);
  if (is_integer(format)) return 0.0;
  const int bits = channel_bits(format, channel);
  if (info.kind == TexelKind::unorm) return 1.01 / (std::ldexp(1.0, bits) - 1);
  if (info.kind == TexelKind::snorm) return 1.01 / (std::ldexp(1.0, bits - 1) - 1);
  // A unit in the last place of floats with a mantissa of 10 bits (16), 6 (11) or 5 (10), and roundings in between with 23.
  const int mantissa = bits == 32 ? 20 : bits == 16 ? 10 : bits - 5;
  return std::ldexp(std::max(std::fabs(value), 0x1p-14), -mantissa) * 1.01;
}

}  // namespace halfspace::test
