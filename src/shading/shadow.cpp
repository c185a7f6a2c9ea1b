// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/shadow.h"

#include "halfspace/shading/shadow_lookup.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

template float shadow_factor(const Shadow&, const ShadowReceiver<float>&);
template double shadow_factor(const Shadow&, const ShadowReceiver<double>&);
template FragmentReal shadow_factor(const Shadow&, const ShadowReceiver<FragmentReal>&);
#if HALFSPACE_LANES > 1
template Real shadow_factor(const Shadow&, const ShadowReceiver<Real>&);
#endif

}  // namespace halfspace::inline HS_LANES_NAMESPACE
