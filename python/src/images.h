// SPDX-License-Identifier: Apache-2.0
//
// Images from arrays.
#pragma once

#include <cstring>

#include "bindings.h"
#include "halfspace/core/image.h"

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

template <class T>
Image<glm::vec<4, T>> rgba_of(const Array<T>& array) {
  Image<glm::vec<4, T>> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  std::memcpy(image.data(), array.data(), static_cast<std::size_t>(array.nbytes()));
  return image;
}

/// Copies an array of uint8, uint16 or float32, of shape (H, W, 4).
inline ColorPicture pixels_of(const py::array& array) {
  if (py::isinstance<Array<uint8_t>>(array)) return rgba_of(array.cast<Array<uint8_t>>());
  if (py::isinstance<Array<uint16_t>>(array)) return rgba_of(array.cast<Array<uint16_t>>());
  return rgba_of(array.cast<Array<float>>());
}

/// Copies an array of shape (H, W, 4).
inline Image<glm::vec4> light_of(const Array<float>& array) { return rgba_of(array); }

}  // namespace halfspace::python
