// SPDX-License-Identifier: Apache-2.0
//
// Slopes of height maps, for bump mapping.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/shading/texture/sampler.h"

namespace halfspace::HS_LANES {

/// Returns (∂h/∂u, ∂h/∂v, 0, 0) at the texel centers; u and v span the map from 0 to 1. Slopes are central differences that follow
/// the wrap mode. At edges that do not wrap they are one-sided differences. Filtering is linear, so filtered slopes are the slopes
/// of the filtered heights, at every mip level.
Image<glm::vec4> height_slopes(const Image<float>& heights, Wrap wrap_s, Wrap wrap_t);

/// Converts heights to 16-bit unorm, clamped to [0, 1].
Image<uint16_t> codes16(const Image<float>& heights);

}  // namespace halfspace::HS_LANES
