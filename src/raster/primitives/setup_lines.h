// SPDX-License-Identifier: Apache-2.0
//
// Setup of the lines of line draws. Output: elements of Chunk::triangles.
#pragma once

#include "halfspace/raster/primitives/setup_range.h"

namespace halfspace::HS_LANES {

/// Sets up the next `count` lines of a draw range.
void set_up_lines(SetupRange& range, uint32_t count);

}  // namespace halfspace::HS_LANES
