// SPDX-License-Identifier: Apache-2.0
//
// Instantiates shadow_factor() of shadow.h.
#include "halfspace/shading/shadow/shadow_lookup.h"

namespace halfspace::HS_LANES {

template float shadow_factor(const Shadow&, const ShadowReceiver<float>&);
template double shadow_factor(const Shadow&, const ShadowReceiver<double>&);
template FragmentReal shadow_factor(const Shadow&, const ShadowReceiver<FragmentReal>&);
#if HALFSPACE_LANES > 1
template Real shadow_factor(const Shadow&, const ShadowReceiver<Real>&);
#endif

}  // namespace halfspace::HS_LANES
