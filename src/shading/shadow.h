// SPDX-License-Identifier: Apache-2.0
//
// The share of one light that arrives at a point.
#pragma once

#include "shading/shadow_bias.h"
#include "shading/shadow_filter.h"

namespace halfspace {

/// 0 (in shadow) … 1 (lit). Of several views the first counts that holds the point with all texels that the filter asks.
/// Outside of all views, and behind the light, a point is lit.
template <class R>
HS_INLINE R light_arriving(const Shadow& shadow, const ShadowReceiver<R>& at) {
  R light(1);
  MaskOf<R> open = light == R(1);
  const float margin = filter_reach(shadow.settings);
  for (const ShadowView& view : shadow.views) {
    const ShadowPlace<R> p = biased_place(view, shadow.settings, at);
    const MaskOf<R> here = open && holds(view, p, margin);
    if (none(here)) continue;
    light = select(here, filtered_shadow(view, shadow.settings, p, at), light);
    open = open && !here;
    if (none(open)) break;
  }
  return light;
}

}  // namespace halfspace
