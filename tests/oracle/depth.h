// SPDX-License-Identifier: Apache-2.0
//
// The depth of a pixel. Input: a triangle in the window, and a position. Output: its window depth, limited to the depths of its vertices
// and to the depth range.
#pragma once

#include <utility>

#include "halfspace/raster/draw_state.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// Returns the depth for the determinants E1 and E2.
float depth_sum(const WindowTriangle& t, const DepthState& state, float e1, float e2);

/// Returns the determinants E1 = d × e2 and E2 = e1 × d in float, where d is the vector from vertex 0 to the point.
std::pair<float, float> float_determinants(const WindowTriangle& t, const Point& at);

/// Returns the window depth for the depth test.
float tested_depth(const WindowTriangle& t, const DepthState& state, const Point& at);

}  // namespace halfspace::oracle
