// SPDX-License-Identifier: Apache-2.0
//
// A decoded image, and the steps that turn the pixels of a file into upright pixels with straight alpha.
#pragma once

#include <cstddef>
#include <vector>

#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

/// Pixels in rows without padding, with interleaved channels.
struct Picture {
  int width = 0, height = 0, channels = 0;
  int alpha_channel = -1;  ///< -1: none
  Sample sample = Sample::uint8;
  std::vector<std::byte> pixels;

  std::size_t pixel_bytes() const { return static_cast<std::size_t>(channels) * sample_bytes(sample); }
};

/// A rectangle of pixels, in coordinates in which y points down.
struct Window {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const Window&, const Window&) = default;
};

/// Returns a picture with all samples 0.
Picture empty_picture(int width, int height, const Picture& like);

/// Converts premultiplied colors to straight colors. Where alpha is 0, colors are unchanged.
void divide_by_alpha(Picture& p);

/// Removes the alpha channel from the description of a picture if all its values are 0.
void drop_empty_alpha(Picture& p);

/// Returns the upright picture. orientation: 1 to 8, as in TIFF's tag 274; other values are ignored. It states which edges of the upright
/// picture the first row and the first column of p are: 1 top left, 2 top right, 3 bottom right, 4 bottom left, 5 left top, 6 right top,
/// 7 right bottom, 8 left bottom.
Picture upright(Picture p, int orientation);

/// Returns the part of p that is inside `window`; the rest of the window is 0. place: where p is.
Picture in_window(const Picture& p, const Window& place, const Window& window);

}  // namespace halfspace::HS_LANES
