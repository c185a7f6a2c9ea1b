// SPDX-License-Identifier: Apache-2.0
//
// Varyings of large triangles with the same w at all vertices. They are linear in the window, so they are evaluated from planes instead of
// barycentric weights (shading/pixel.h). A plane is relative to an anchor near the pixel, because floats are not precise enough for the
// value at a distant point and the slopes.
//
// The anchor depends only on the triangle and the cell of the pixel. The window is divided into cells of 64x64 pixels, and the anchor is
// the center of the part of the cell that the bounding box of the triangle overlaps. A tile is always in a single cell.
//
// The value at the anchor and the slopes are computed in double and rounded to float once. Let M be the largest |value| at the vertices, u
// = 2^-24, and (dx, dy) the offset of a point of the triangle. Rounding of the value a at the anchor, both slopes, the first sum (a −
// slope_y·dy) and the result gives an error of at most
//   u·(|a| + |slope_x·dx| + |slope_y·dy| + (M + |slope_y·dy|) + M).
// The bound is a convex function of the vertex values, so it is largest if all of them are ±M. Either they are equal, and the bound is
// 3·u·M. Or one of them differs, at a vertex k with the barycentric weight b and the slopes gx and gy at the anchor, and the bound is
//   u·M·(|1 − 2b| + 2·|gx·dx| + 4·|gy·dy| + 2).
// A triangle is given as planes in a cell if this is at most 5·u·M = 3e-7·M for every vertex, as with barycentric weights.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Vertex of a triangle in window coordinates.
struct PlaneCorner {
  int64_t x, y;  ///< 1/256 px
  float inv_w;
};

/// Lower left pixel of a cell.
struct PlaneCell {
  static constexpr int kSize = 64;  ///< px

  int x = 0, y = 0;

  /// Returns the cell that contains a pixel.
  static PlaneCell of(int x, int y) { return {x & ~(kSize - 1), y & ~(kSize - 1)}; }
  bool operator==(const PlaneCell&) const = default;
};

/// Reference point of the planes of a triangle, and the barycentric weights of its second and third vertex there. Slopes are per 1/256 px.
struct PlaneAnchor {
  bool is_valid = false;  ///< false: the triangle is not given as planes
  int64_t x = 0, y = 0;   ///< 1/256 px
  double b1 = 0, b2 = 0;
  double b1_x = 0, b1_y = 0, b2_x = 0, b2_y = 0;

  /// Returns the value at the anchor and the slopes along x and y of a varying with the given values at the vertices.
  std::array<float, 3> plane(float a0, float a1, float a2) const {
    const double d1 = static_cast<double>(a1) - static_cast<double>(a0), d2 = static_cast<double>(a2) - static_cast<double>(a0);
    return {static_cast<float>(static_cast<double>(a0) + (b1 * d1 + b2 * d2)), static_cast<float>(b1_x * d1 + b2_x * d2),
            static_cast<float>(b1_y * d1 + b2_y * d2)};
  }
};

/// Returns the anchor of a triangle with counter-clockwise vertices for the pixels of a cell.
PlaneAnchor plane_anchor(const std::array<PlaneCorner, 3>& corner, const PlaneCell& cell);

}  // namespace halfspace::HS_LANES
