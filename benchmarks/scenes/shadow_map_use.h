// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "workloads/workload.h"

namespace halfspace {

/// Counts the texels of `map` that the 3 x 3 filters of all pixels with a depth below 1 read. The filters are centered at the surface: the
/// offset along the normal, which is at most about three texels, is left out.
ShadowMapUse shadow_map_use(const Image<float>& depth, const glm::dmat4& clip_from_world, const glm::dmat4& light_from_world,
                            const Image<float>& map);

}  // namespace halfspace
