// SPDX-License-Identifier: Apache-2.0
//
// The share of one light that arrives at a point: what a surface's shader asks of a shadow map.
#pragma once

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/shadow_map.h"

namespace halfspace {

/// 0 (in shadow) … 1 (lit). Of several views the first counts that holds the point with all texels that the filter asks.
/// Outside of all views, and behind the light, a point is lit.
template <class R>
R shadow_factor(const Shadow& shadow, const ShadowReceiver<R>& at);

extern template float shadow_factor(const Shadow&, const ShadowReceiver<float>&);
extern template double shadow_factor(const Shadow&, const ShadowReceiver<double>&);
extern template FragmentReal shadow_factor(const Shadow&, const ShadowReceiver<FragmentReal>&);
#if HALFSPACE_LANES > 1
extern template Real shadow_factor(const Shadow&, const ShadowReceiver<Real>&);
#endif

}  // namespace halfspace
