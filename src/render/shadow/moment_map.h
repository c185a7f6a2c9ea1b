// SPDX-License-Identifier: Apache-2.0
//
// Filtered moment maps for the filters `vsm` and `moments`, computed from a depth map and read by shading/shadow/shadow_moments.h.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/shading/shadow/shadow_map.h"

namespace halfspace::HS_LANES {

/// Returns the mean of the first four powers of linear depth over squares of 2·radius + 1 texels, with the map clamped at its
/// edges. `depth` holds size² reversed window depths, top row first. radius ≥ 0.
Image<glm::vec4> filtered_moments(const ShadowView& view, const Image<float>& depth, int radius, const Workers& workers);

}  // namespace halfspace::HS_LANES
