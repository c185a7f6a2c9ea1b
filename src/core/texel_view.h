// SPDX-License-Identifier: Apache-2.0
//
// Views of texels in memory that somebody else owns: of images, of the targets of passes, and of the levels, layers and faces of textures.
#pragma once

#include <cstddef>
#include <type_traits>

#include "halfspace/core/check.h"
#include "halfspace/core/image.h"
#include "halfspace/core/texel_format.h"

namespace halfspace::HS_LANES {

/// One or more layers of width × height texels. Row 0 is at t = 0 of a texture and at y = 0, the bottom, of the window of a pass, as in
/// OpenGL. What one pass draws into a view can therefore be sampled through the same view. Images that store the top row first, as files
/// do, are drawn into with rows in reverse: flipped().
///
/// Byte is std::byte, or const std::byte for texels that are only read. The memory must outlive the view.
template <class Byte>
struct BasicTexelView {
  TexelFormat format = TexelFormat::none;
  Byte* data = nullptr;  ///< texel (0, 0) of layer 0
  int width = 0, height = 0;
  int layers = 1;
  std::ptrdiff_t row_pitch = 0;    ///< bytes from a row to the next one; negative if rows are stored in reverse
  std::ptrdiff_t layer_pitch = 0;  ///< bytes from a layer to the next one

  /// A view to write is also one to read.
  operator BasicTexelView<const Byte>() const requires(!std::is_const_v<Byte>) {
    return {format, data, width, height, layers, row_pitch, layer_pitch};
  }

  /// Returns the address of a texel, which must be inside the view.
  Byte* at(int x, int y, int layer = 0) const {
    HS_DCHECK(x >= 0 && x < width && y >= 0 && y < height && layer >= 0 && layer < layers);
    return data + layer * layer_pitch + y * row_pitch + x * std::ptrdiff_t{texel_info(format).bytes};
  }

  /// Returns the same texels with the rows in reverse.
  BasicTexelView flipped() const {
    BasicTexelView view = *this;
    if (height > 0) view.data += (height - 1) * row_pitch;
    view.row_pitch = -row_pitch;
    return view;
  }

  /// Returns a view of some of the layers, which must exist.
  BasicTexelView part_of_layers(int first, int count = 1) const {
    HS_CHECK(first >= 0 && count >= 1 && first <= layers - count, "TexelView: there are no such layers; expected layers of the view");
    BasicTexelView view = *this;
    view.data += first * layer_pitch;
    view.layers = count;
    return view;
  }

  /// Returns a view of a rectangle of all layers, which must be inside.
  BasicTexelView part(int x, int y, int part_width, int part_height) const {
    HS_CHECK(x >= 0 && y >= 0 && part_width >= 1 && part_height >= 1 && x <= width - part_width && y <= height - part_height,
             "TexelView: the rectangle is not inside the view; expected one of at least one texel inside");
    BasicTexelView view = *this;
    view.data = at(x, y);
    view.width = part_width;
    view.height = part_height;
    return view;
  }
};
using TexelView = BasicTexelView<std::byte>;
using ConstTexelView = BasicTexelView<const std::byte>;

/// Returns a view of an image, row 0 of the image first. A pixel of the image must have the size of a texel.
template <class Pixel>
TexelView texel_view(Image<Pixel>& image, TexelFormat format) {
  HS_CHECK_OP(sizeof(Pixel), ==, std::size_t{texel_info(format).bytes},
              "texel_view: the pixels of the image have another size than the format; expected the size of a texel");
  const auto pitch = static_cast<std::ptrdiff_t>(sizeof(Pixel)) * image.width();
  return {format, reinterpret_cast<std::byte*>(image.data()), image.width(), image.height(), 1, pitch, pitch * image.height()};
}
template <class Pixel>
ConstTexelView texel_view(const Image<Pixel>& image, TexelFormat format) {
  return texel_view(const_cast<Image<Pixel>&>(image), format);
}

}  // namespace halfspace::HS_LANES
