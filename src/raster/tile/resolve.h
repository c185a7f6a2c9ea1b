// SPDX-License-Identifier: Apache-2.0
//
// Resolve. In: a tile's colours, several samples a pixel. Out: the mean of each pixel's samples, in linear light, as sample 0.
#pragma once

#include "halfspace/raster/tile/blend.h"

namespace halfspace {

/// Changes nothing where there is one sample a pixel.
void resolve_color(const Tile& tile, ColorBuffer& color);

}  // namespace halfspace
