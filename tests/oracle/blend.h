// SPDX-License-Identifier: Apache-2.0
//
// Blending. Input: the colors of a fragment and the color in the framebuffer. Output: the blended color.
#pragma once

#include "halfspace/raster/draw_state.h"

namespace halfspace::oracle {

/// unit: number of steps from 0 to 1 in the result. An attachment of rgba8 is blended in units of its codes. clamps_factors: the attachment
/// is signed normalized, so factors are clamped to [−1, 1]; those of unsigned normalized ones are in [0, 1].
glm::vec4 blend(const BlendState& b, const glm::vec4& src, const glm::vec4& src1, const glm::vec4& dst, const glm::vec4& constant,
                float unit, bool clamps_factors);

}  // namespace halfspace::oracle
