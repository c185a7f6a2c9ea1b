// SPDX-License-Identifier: Apache-2.0
//
// Smooth lines and polygons in passes with one sample per pixel (OpenGL 4.6, sections 14.5.4 and 14.6.6). Input: a primitive. Output: the
// area of each pixel that it covers. OpenGL allows any approximation of this area; here it is exact up to the rounding of doubles
// (Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17, 1974).
//
// The bits of the result depend on the order of operations: the corners, relative to the lower left one of the pixel, are clipped at the
// left, right, lower and upper side. The area is the sum of the triangles of a fan from the first corner that is left.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// The area that a smooth primitive covers, as a convex polygon in counter-clockwise order. Coordinates are in pixels.
class SmoothArea {
 public:
  /// t: a triangle, or a line, of which the area is a rectangle with the width of the line.
  SmoothArea(const Draw& draw, const Triangle& t);

  /// Returns the pixels that the area may overlap, clipped to bounds.
  PixelBounds pixels(const PixelBounds& bounds) const;
  /// Returns the area of the part in pixel (x, y), from 0 to 1.
  double in_pixel(int x, int y) const;

 private:
  std::array<glm::dvec2, 4> corners_;
  std::size_t count_;
};

}  // namespace halfspace::HS_LANES
