// SPDX-License-Identifier: Apache-2.0
//
// Limits on image sizes, checked before memory is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "halfspace/core/resource_limits.h"

namespace halfspace::HS_LANES {

inline constexpr uint32_t kMaxImageEdge = 32768;  // same as Texture2D::kMaxSize
inline constexpr uint64_t kMaxImagePixels = ResourceLimits::kMaxPixels;

/// Throws an InputError that begins with `name` if an image of this size is not supported. If it is too large, the error is a LimitError.
inline void check_image_size(uint64_t width, uint64_t height, const std::string& name) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (width == 0 || height == 0) throw InputError(name + ": has " + size + "; expected at least 1x1");
  if (width > kMaxImageEdge || height > kMaxImageEdge || width * height > kMaxImagePixels) {
    throw LimitError(name + ": claims " + size + "; expected at most 2^28 pixels and 32768 pixels per side");
  }
}

/// Returns the memory of a texture with its mip levels, or of a converted copy of an image. An rgba8 texture takes 2.17 times the memory of
/// the image: 1.5 for its texels and 0.67 for a copy of their alpha.
inline uint64_t texture_memory(uint64_t width, uint64_t height, uint64_t bytes_per_pixel) {
  return width * height * bytes_per_pixel / 4 * 9;
}

/// Returns the memory that is needed to decode an image and then make a texture, or a converted copy.
inline uint64_t decoding_memory(uint64_t width, uint64_t height, uint64_t bytes_per_pixel) {
  return width * height * bytes_per_pixel + texture_memory(width, height, bytes_per_pixel);
}

}  // namespace halfspace::HS_LANES
