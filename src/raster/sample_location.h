// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the place of a sample in its pixel, from the lower left corner at (0, 0) to the upper right one at (1, 1), in window coordinates
/// (glGetMultisamplefv with GL_SAMPLE_POSITION). samples must be 1, 2, 4 or 8, and sample one of them, from 0; otherwise an HS_CHECK fails.
/// These are the standard locations of Vulkan 1.3, with y up.
glm::vec2 sample_location(int samples, int sample);

}  // namespace halfspace::HS_LANES
