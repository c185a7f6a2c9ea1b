// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/shadow.h"

#include "halfspace/shading/shadow_lookup.h"

namespace halfspace {

template float light_arriving(const Shadow&, const ShadowReceiver<float>&);
template double light_arriving(const Shadow&, const ShadowReceiver<double>&);
template FragmentReal light_arriving(const Shadow&, const ShadowReceiver<FragmentReal>&);
#if HALFSPACE_LANES > 1
template Real light_arriving(const Shadow&, const ShadowReceiver<Real>&);
#endif

}  // namespace halfspace
