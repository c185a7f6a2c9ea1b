// SPDX-License-Identifier: Apache-2.0
//
// The shadow lookup that surface shaders call.
#pragma once

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/shadow/shadow_map.h"

namespace halfspace::HS_LANES {

/// Returns the fraction of the light that reaches the point, from 0 (in shadow) to 1 (lit). The first view that contains the point
/// with the whole filter kernel is used. Points outside all views or behind the light are lit. In addition, light fades where the smooth
/// surface turns away from the light but the shading normal does not (terminator_fraction in shading/shadow/terminator.h).
template <class R>
R shadow_factor(const Shadow& shadow, const ShadowReceiver<R>& at);

extern template float shadow_factor(const Shadow&, const ShadowReceiver<float>&);
extern template double shadow_factor(const Shadow&, const ShadowReceiver<double>&);
extern template FragmentReal shadow_factor(const Shadow&, const ShadowReceiver<FragmentReal>&);
#if HALFSPACE_LANES > 1
extern template Real shadow_factor(const Shadow&, const ShadowReceiver<Real>&);
#endif

}  // namespace halfspace::HS_LANES
