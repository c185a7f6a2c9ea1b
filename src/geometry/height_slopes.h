// SPDX-License-Identifier: Apache-2.0
//
// Maps of heights made ready for bumps.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/shading/sampler.h"

namespace halfspace {

/// (∂h/∂u, ∂h/∂v, 0, 0) at the texels' centres, u and v spanning the whole map from 0 to 1: the slope of the parabola
/// through a texel and its neighbours on both sides, as the map wraps; at an edge that does not, that of the line to the
/// one neighbour. Filtering and its levels are linear, so filtered slopes are the slopes of filtered heights.
Image<glm::vec4> height_slopes(const Image<float>& heights, Wrap wrap_s, Wrap wrap_t);

/// Heights as 16-bit codes, held to [0, 1].
Image<uint16_t> codes16(const Image<float>& heights);

}  // namespace halfspace
