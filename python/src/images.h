// SPDX-License-Identifier: Apache-2.0
//
// Images from arrays.
#pragma once

#include <cstring>

#include "bindings.h"

namespace halfspace::python {

/// Copies an array of shape (H, W, 3) or (H, W, 4).
inline Image<glm::u8vec4> codes_of(const Array<uint8_t>& array) {
  const auto channels = static_cast<std::size_t>(array.shape(2));
  Image<glm::u8vec4> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const uint8_t* in = array.data();
  glm::u8vec4* out = image.data();
  for (std::size_t i = 0; i < image.texels().size(); ++i, in += channels) {
    out[i] = glm::u8vec4(in[0], in[1], in[2], channels == 4 ? in[3] : uint8_t{255});
  }
  return image;
}

/// Copies an array of shape (H, W, 4).
inline Image<glm::vec4> light_of(const Array<float>& array) {
  Image<glm::vec4> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::memcpy(image.data(), array.data(), static_cast<std::size_t>(array.nbytes()));
  return image;
}

}  // namespace halfspace::python
