// SPDX-License-Identifier: Apache-2.0
//
// Areas of smooth lines and polygons. Input: the convex polygon that a primitive covers, in pixels and in counter-clockwise order, and a
// pixel. Output: the area of the pixel that it covers. The areas are rounded, so they follow the order of operations that
// raster/pipeline/smooth_area.h specifies; tests/raster/smooth_test.cpp and the conformance cases compare them with closed forms.
#pragma once

#include <cstdint>
#include <vector>

#include "oracle/window.h"

namespace halfspace::oracle {

/// Returns the polygon of a triangle with these corners, or of a line of this width.
std::vector<glm::dvec2> smooth_triangle(const std::array<Corner, 3>& corners);
std::vector<glm::dvec2> smooth_line(const Corner& nearer, const Corner& farther, float width);

/// Returns the pixels that a polygon may overlap.
Box smooth_box(const std::vector<glm::dvec2>& polygon);
/// Returns the part of a pixel that a polygon covers, from 0 to 1.
float smooth_area(const std::vector<glm::dvec2>& polygon, int64_t x, int64_t y);

}  // namespace halfspace::oracle
