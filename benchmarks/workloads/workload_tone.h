// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/fixed_power.h"
#include "halfspace/core/vec.h"

namespace halfspace {

/// Tone mapping: (c/(1 + c))^(1/2.2), where c is 0.8 times the light. Sets alpha to 1.
struct WorkloadTone {
  FixedPower encode{1.0f / 2.2f};

  template <class R>
  vec4<R> operator()(const vec4<R>& light) const {
    vec4<R> out(R(0), R(0), R(0), R(1));
    for (int k = 0; k < 3; ++k) {
      const R c = R(0.8f) * light[k];
      out[k] = encode(c / (R(1) + c));
    }
    return out;
  }
};

}  // namespace halfspace
