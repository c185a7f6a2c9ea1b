// SPDX-License-Identifier: Apache-2.0
//
// Exact area coverage: how much of each pixel convex polygons cover, by clipping them to the pixel.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace {

using TrianglePx = std::array<glm::dvec2, 3>;  ///< window coordinates, y up

/// The share of each pixel that triangles without common points cover, top row first (Sutherland and Hodgman, "Reentrant polygon
/// clipping", 1974, then the trapezoid rule). T: double, or long double to tell double's error.
template <class T>
Image<T> area_coverage(const std::vector<TrianglePx>& triangles, int width, int height);

}  // namespace halfspace
