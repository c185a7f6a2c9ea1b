// SPDX-License-Identifier: Apache-2.0
//
// Interpolation. Input: a triangle in the window with the varyings of its vertices. Output: the varyings and the depth at a position, as
// passed to the fragment function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "halfspace/shading/contract.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// Input of interpolation for one triangle. Vertex 0 is the one with the smallest 1/w. If the lanes are planar, the values are planes.
struct Surface {
  TriangleLanes<float> lanes;
  std::vector<float> value0, delta1, delta2;
};

/// A point on the surface of a triangle and its interpolation weights.
struct SurfacePoint {
  Weights<float> weights;
  float dx, dy;  ///< from vertex 0 or the center of the planes, in 1/256 px
  float z;       ///< window depth as passed to shaders
};

inline constexpr int64_t kCellSize = 64;  ///< width and height of a cell, in pixels

Surface make_surface(const WindowTriangle& t, std::span<const Interpolation> interpolations);
/// Returns the input of interpolation for the pixels of a cell of 64 x 64 pixels. whole: the result of make_surface().
Surface surface_in_cell(const WindowTriangle& t, const Surface& whole, std::span<const Interpolation> interpolations, int64_t cell_x,
                        int64_t cell_y);
SurfacePoint surface_point(const Surface& s, const WindowTriangle& t, const DepthState& state, const Point& at);
float component_at(const Surface& s, const SurfacePoint& p, Interpolation mode, std::size_t component);

}  // namespace halfspace::oracle
