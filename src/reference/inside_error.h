// SPDX-License-Identifier: Apache-2.0
//
// Measures the errors of colors inside of outlines, apart from the errors of the outlines.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace::HS_LANES {

/// The differences between a picture and a reference picture of the same scene. Colors are compared where both show the same object.
struct InsideError {
  int64_t inside = 0;     ///< pixels that show the same object in both pictures
  int64_t differing = 0;  ///< pixels that show different objects, or an object in one picture only
  double mean = 0.0;      ///< mean absolute difference of red, green and blue over the inside pixels, in steps of 8-bit values; 0 if none
  double p99 = 0.0;       ///< 99th percentile, over the inside pixels, of the largest difference of red, green and blue, in the same unit
};

/// An 8-bit picture, and the object that each pixel shows (seen_objects, without finer pixels). Neither is owned.
struct PictureOfObjects {
  const Image<glm::u8vec4>& colors;
  const Image<int>& objects;
};

/// Compares a picture with the reference `truth`. All images must have the same size. The picture must have one sample per pixel, because
/// pixels on the outline of an antialiased picture are mixtures of two surfaces.
InsideError inside_error(const PictureOfObjects& picture, const PictureOfObjects& truth);

}  // namespace halfspace::HS_LANES
