// SPDX-License-Identifier: Apache-2.0
//
// Exact area coverage: clips triangles to each pixel and sums the areas.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace {

using TrianglePx = std::array<glm::dvec2, 3>;  ///< window coordinates, y up

/// Returns the fraction of each pixel that is covered by triangles, top row first. The triangles must not overlap. Clips as in Sutherland
/// and Hodgman, "Reentrant polygon clipping", 1974. T: double, or long double to estimate the error of double.
template <class T>
Image<T> area_coverage(const std::vector<TrianglePx>& triangles, int width, int height);

}  // namespace halfspace
