// SPDX-License-Identifier: Apache-2.0
//
// Clipping. Input: a triangle or line in clip space. Output: the part inside w > 0, the near and far planes, the guard band and the clip
// distances, as a convex polygon. Each vertex of the polygon (a "corner") is a weighted sum of the three vertices of the triangle. Most
// triangles are not clipped, because the rasterizer limits triangles that only cross the sides of the view volume to the pixels of the
// target.
//
// Uses the algorithm of Sutherland and Hodgman, "Reentrant polygon clipping" (CACM 17, 1974), in double precision. A new corner is always
// computed from the inside end of its edge, and planes are processed in the same order for all triangles. Two triangles that share an edge
// therefore get bit-identical corners on it.
#pragma once

#include <array>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// In exact arithmetic, clipping a triangle by n planes results in at most 3 + n corners. With rounding, an edge can be bent so that a
/// plane cuts it twice.
inline constexpr int kFixedPlanes = 7;
inline constexpr int kClipPlanes = kFixedPlanes + 8;
inline constexpr int kMaxCorners = 3 + 2 * kClipPlanes;
/// Returns the maximum number of corners of a triangle that is clipped by the fixed planes and by `clip_distances` additional planes.
constexpr int max_corners(int clip_distances) { return 3 + 2 * (kFixedPlanes + clip_distances); }

struct ClipCorner {
  glm::dvec4 pos_clip;
  glm::dvec3 weights;  ///< weights of the triangle's vertices: linear in clip space, with a sum of 1
  int vertex = -1;     ///< the triangle's vertex at this corner, or −1 if the corner is on a plane
};

struct ClipPolygon {
  std::array<ClipCorner, kMaxCorners> corners;
  int count = 0;  ///< 0: nothing is left
};

/// Clip distances of a primitive's vertices, `count` per vertex.
struct ClipDistances {
  std::array<const float*, 3> vertex{};
  int count = 0;
};

/// Clips a triangle. pos_clip must be finite. The polygon has the same orientation as the triangle.
ClipPolygon clip_triangle(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                          const ClipDistances& distances = {});

/// Clips the line between the first two vertices. The result has two corners, or none.
ClipPolygon clip_line(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                      const ClipDistances& distances);

/// Returns the snapped window position of a corner. As for other vertices, depth and varyings are not adjusted to the snapped position,
/// which differs by at most 1/512 px in x and y.
ScreenVertex project_corner(const Viewport& viewport, const glm::dvec4& pos_clip);

/// Writes the varyings of corner c to out. Smooth and linear varyings are interpolated. Flat ones are taken from the provoking vertex.
/// rows: varyings of the three vertices; w: their clip-space w; modes: one per varying.
void interpolate_corner(const ClipCorner& c, const std::array<double, 3>& w, const std::array<const float*, 3>& rows, int provoking,
                        std::span<const Interpolation> modes, float* out);

/// Returns twice the signed area of a triangle; it is positive for counter-clockwise triangles.
inline int64_t orient2d(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{b.y - a.y} * (c.x - a.x);
}

/// Triangle fan of a clipped polygon.
///
/// Snapping can make a nearly straight corner concave. A fan from the wrong corner would then contain triangles with the opposite winding,
/// and some samples would be drawn twice. All triangles of a fan from `apex` have the same winding. If the outline of a sliver intersects
/// itself, no corner has this property. Triangles with the opposite winding are then skipped; their samples are covered by the others.
struct Fan {
  uint32_t apex = 0;
  bool counter_clockwise = false;
};

/// Finds the best fan for a polygon with `count` vertices.
inline Fan fan_of(const ClipVertex* v, uint32_t count) {
  Fan fan;
  for (uint32_t apex = 0; apex < count; ++apex) {
    bool left = false, right = false;
    int64_t area = 0;
    for (uint32_t i = 2; i < count; ++i) {
      const int64_t piece = orient2d(v[apex].screen, v[(apex + i - 1) % count].screen, v[(apex + i) % count].screen);
      left |= piece > 0;
      right |= piece < 0;
      area += piece;
    }
    fan = {apex, area > 0};
    if (!(left && right)) return fan;
  }
  return fan;
}

}  // namespace halfspace::HS_LANES
