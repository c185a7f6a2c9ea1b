// SPDX-License-Identifier: Apache-2.0
//
// Constant-colour tiles: tiles that nothing is drawn in, or that one or two triangles of a constant shader cover. Their colour goes
// straight into the images, many tiles at a time.
#pragma once

#include <optional>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/attachments.h"

namespace halfspace {

/// The pixels of tiles [tile_x0, tile_x1) of a row of tiles, inside the target.
PixelBounds tile_pixels(const PassContext& context, int tile_x0, int tile_x1, int tile_y);

/// Decides whether tiles [tile_x0, tile_x1) of a row get one colour: that of the returned draw, or, where it is null, the clear value
/// together with the clear depth. Nothing is returned where they need rasterizing. Counts what the draw draws. The round must be the
/// only one.
std::optional<const Draw*> constant_tiles(const PassContext& context, const Attachments& attachments, int tile_x0, int tile_x1, int tile_y,
                                          PassStatistics& statistics);

/// Pixels of one colour: that of a draw whose shader is constant, or (null) the clear values.
struct ConstantArea {
  PixelBounds pixels;
  const Draw* draw;
};

/// Writes the area's colour into the images. An empty area is left out.
void fill_images(const PassContext& context, const Attachments& attachments, const ConstantArea& area);

}  // namespace halfspace
