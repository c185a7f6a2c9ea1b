// SPDX-License-Identifier: Apache-2.0
//
// Maps of filtered moments, for the filters `vsm` and `moments`. In: a view and its map of depths. Out: what shading/shadow_moments.h
// reads.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/shading/shadow_map.h"

namespace halfspace {

/// Means of the powers 1 to 4 of the linear depth over squares of 2·radius + 1 texels; beyond the edge counts the edge. `depth` holds
/// size² reversed window depths, top row first; radius ≥ 0.
Image<glm::vec4> filtered_moments(const ShadowView& view, const Image<float>& depth, int radius, const Workers& workers);

}  // namespace halfspace
