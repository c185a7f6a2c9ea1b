// SPDX-License-Identifier: Apache-2.0
//
// Points, triangles and boxes in the window. The primitive stage writes the triangles; coverage, depth and interpolation read them.
// Coordinates are in 1/256 px. Lines and points are stored as triangles, too.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "oracle/framebuffer.h"

namespace halfspace::oracle {

/// A point in the window, in 1/256 px.
struct Point {
  int64_t x = 0, y = 0;
};
Point center_of(int x, int y);
/// Returns the position of a sample, from the standard positions for the given sample count.
Point position_of(const Sample& s, int samples);

/// A vertex of a triangle in the window.
struct Corner {
  int64_t x = 0, y = 0;  ///< 1/256 px
  float z = 0.0f;        ///< window depth before offset and clamping
  float inv_w = 0.0f;
  std::vector<float> varyings;
};

/// A triangle in the window. Corners are in counter-clockwise order (y up) and begin with the one of smallest depth.
struct WindowTriangle {
  std::array<Corner, 3> corner;
  std::vector<float> flat;  ///< varyings of the provoking vertex
  bool front = false;
  int64_t area = 0;                ///< twice the area, in (1/256 px)²
  float z0 = 0, z_max = 0;         ///< smallest and largest depth, including the offset
  float z_step1 = 0, z_step2 = 0;  ///< depth per unit of E1 and E2

  bool is_line = false;  ///< a line of `width` pixels from `from` to `to`; vertex 2 is next to vertex 0
  Point from, to;
  int width = 1;
  bool is_point = false;  ///< a point or sprite at vertex 0 that covers the rectangle from low to high (exclusive)
  Point low, high;
  PointOrigin origin = PointOrigin::upper_left;
  std::vector<glm::dvec2> smooth;  ///< if not empty, the polygon that a smooth line or triangle covers (smooth_area.h)
};

/// A rectangle of pixels.
struct Box {
  int64_t x0, y0, x1, y1;  ///< x1 and y1 are exclusive
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

Box intersect(const Box& a, const Box& b);

/// Returns whether a triangle with this winding in the window is front-facing.
bool is_front_facing(const DrawState& state, bool counter_clockwise);

/// Returns the pixels of the target that are in the viewport and the scissor rectangle.
Box allowed_pixels(const Framebuffer& target, const DrawState& state);

/// Returns the pixels that may have a sample in the closed bounding box, based on the bounding box of the sample positions.
Box covered_box(const WindowTriangle& t, int samples);

/// Returns whether a triangle is so small that its depth is computed from exact integer edge functions.
bool is_small(const WindowTriangle& t);

}  // namespace halfspace::oracle
