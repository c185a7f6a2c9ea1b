// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <variant>
#include <vector>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

/// A 2D array of texels or pixels, stored row by row without padding. Row 0 is the top row of an image and corresponds to
/// t = 0 of a texture. The image owns its memory, and copying it copies the texels. Accessors require coordinates inside the
/// image, which is checked only in builds with asserts.
template <class T>
class Image {
 public:
  Image() = default;
  /// Creates an image of texels initialized to T(). width and height must not be negative.
  Image(int width, int height) : width_(width), height_(height) {
    HS_CHECK_OP(width, >=, 0, "Image: the width is negative; expected at least 0");
    HS_CHECK_OP(height, >=, 0, "Image: the height is negative; expected at least 0");
    texels_ = Texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return texels_.empty(); }

  T& at(int x, int row) { return texels_[index(x, row)]; }
  const T& at(int x, int row) const { return texels_[index(x, row)]; }
  std::span<T> row(int r) { return std::span<T>(texels_).subspan(index(0, r), static_cast<std::size_t>(width_)); }
  std::span<const T> row(int r) const { return std::span<const T>(texels_).subspan(index(0, r), static_cast<std::size_t>(width_)); }
  T* data() { return texels_.data(); }
  const T* data() const { return texels_.data(); }
  std::span<const T> texels() const { return texels_; }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  using Texels = std::vector<T, CacheLineAllocator<T>>;

  std::size_t index(int x, int row) const {
    HS_DCHECK(x >= 0 && x < width_ && row >= 0 && row < height_);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  Texels texels_;
};

/// Colors and alpha with 8-bit or 16-bit values, in which colors are sRGB-encoded, or with floating-point values, in which they are linear.
using ColorPicture = std::variant<Image<glm::u8vec4>, Image<glm::u16vec4>, Image<glm::vec4>>;

}  // namespace halfspace::HS_LANES
