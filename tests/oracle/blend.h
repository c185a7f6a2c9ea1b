// SPDX-License-Identifier: Apache-2.0
//
// Blending. Input: the colors of a fragment and the color in the framebuffer. Output: the blended color.
#pragma once

#include "halfspace/raster/draw_state.h"

namespace halfspace::oracle {

/// unit: number of steps from 0 to 1 in the result. An attachment of rgba8 is blended in units of its codes.
glm::vec4 blend(const BlendState& b, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant,
                float unit);

}  // namespace halfspace::oracle
