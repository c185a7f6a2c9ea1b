// SPDX-License-Identifier: Apache-2.0
//
// Implementation of shadow_factor (shading/shadow/shadow.h). It is compiled only in shadow.cpp, so that it is not inlined into every
// shader.
#pragma once

#include "halfspace/shading/shadow/shadow.h"
#include "halfspace/shading/shadow/shadow_bias.h"
#include "halfspace/shading/shadow/shadow_filter.h"
#include "halfspace/shading/shadow/terminator.h"

namespace halfspace::HS_LANES {

template <class R>
R shadow_factor(const Shadow& shadow, const ShadowReceiver<R>& at) {
  R light(1);
  MaskOf<R> open = light == R(1);
  const float margin = filter_reach(shadow.settings);
  for (const ShadowView& view : shadow.views) {
    const ShadowCoordinates<R> p = biased_coordinates(view, shadow.settings, at);
    const MaskOf<R> here = open && holds(view, p, margin);
    if (none(here)) continue;
    light = select(here, filtered_shadow(view, shadow.settings, p, at), light);
    open = open && !here;
    if (none(open)) break;
  }
  return light * terminator_fraction(dot(smooth_normal(at), at.to_light_ws), dot(at.shading_normal_ws, at.to_light_ws));
}

}  // namespace halfspace::HS_LANES
