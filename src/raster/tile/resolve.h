// SPDX-License-Identifier: Apache-2.0
//
// Resolve. Input: the colors of a multisampled tile. Output: the mean of all samples of each pixel, in linear light, stored in sample 0.
#pragma once

#include "halfspace/raster/tile/blend.h"

namespace halfspace::HS_LANES {

/// Does nothing if there is one sample per pixel.
void resolve_color(const Tile& tile, ColorBuffer& color);

}  // namespace halfspace::HS_LANES
