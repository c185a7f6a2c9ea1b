// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the orientation (see upright() in picture.h) that the resolution string of a Radiance picture states, for example 1 for
/// "-Y 512 +X 1024", in which scanlines run to the right and follow each other downwards. Returns 1 if there is no valid string. file: the
/// beginning of the file, with the whole header. Source: Ward, "Radiance File Formats", section Picture File Format.
int radiance_orientation(std::string_view file);

}  // namespace halfspace::HS_LANES
