// SPDX-License-Identifier: Apache-2.0
//
// Constant-color tiles: tiles without geometry, and tiles that one or two triangles of a constant shader cover completely. Their color is
// written directly to the images, many tiles at a time, without going through tile memory.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace::HS_LANES {

/// Returns the pixels of tiles [tile_x0, tile_x1) in a row of tiles, clipped to the render target.
PixelBounds tile_pixels(const PassContext& context, int tile_x0, int tile_x1, int tile_y);

/// Whether tiles have a single color, and the draw that provides it. The draw is null for the clear color and clear depth. This is not a
/// std::optional, which g++ returns through memory: the load then waits until the preceding tile is stored.
struct ConstantTiles {
  bool are_constant;
  const Draw* draw;
};
/// Checks whether tiles [tile_x0, tile_x1) of a row have a single color; otherwise, they have to be rasterized. If a draw is returned, its
/// samples and fragments are added to statistics. The pass must have a single round and no post step.
ConstantTiles constant_tiles(const PassContext& context, const Attachments& attachments, int tile_x0, int tile_x1, int tile_y,
                             PassStatistics& statistics);

/// Area with a single color. It is covered by a draw with a constant shader or, if draw is null, has the clear values.
struct ConstantArea {
  PixelBounds pixels;
  const Draw* draw;
};

/// Writes the color of the area to the images, and the clear depth if draw is null. Does nothing if the area is empty.
void fill_images(const Attachments& attachments, const ConstantArea& area);

}  // namespace halfspace::HS_LANES
