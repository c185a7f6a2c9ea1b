// SPDX-License-Identifier: Apache-2.0
//
// Clip. In: a triangle in clip space. Out: the convex polygon left of it inside w > 0, near, far and the guard band,
// each corner as weights of the three vertices. Rare: only triangles that cross near, far or the guard band come here;
// what crosses the sides of the view alone is cut by its pixel bounds.
//
// Sutherland and Hodgman, "Reentrant polygon clipping" (CACM 17, 1974), in double. A new corner is computed from the
// inside end of its edge, and every triangle meets the planes in the same order, so two triangles that share an edge
// get the same bits on it.
#pragma once

#include <array>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// A triangle cut by n planes has at most 3 + n corners in exact arithmetic; rounding can bend an edge, and cut it twice.
inline constexpr int kFixedPlanes = 7;
inline constexpr int kClipPlanes = kFixedPlanes + 8;
inline constexpr int kMaxCorners = 3 + 2 * kClipPlanes;
/// Corners of what is left of a triangle cut by the fixed planes and that many clip distances.
constexpr int max_corners(int clip_distances) { return 3 + 2 * (kFixedPlanes + clip_distances); }

struct ClipCorner {
  glm::dvec4 pos_clip;
  glm::dvec3 weights;  ///< of the triangle's vertices: linear in clip space, summing to 1
  int vertex = -1;     ///< the triangle's vertex that this corner is, or −1 where a plane cut an edge
};

struct ClipPolygon {
  std::array<ClipCorner, kMaxCorners> corners;
  int count = 0;  ///< 0: nothing is left
};

/// The clip distances of a primitive's vertices: `count` of each.
struct ClipDistances {
  std::array<const float*, 3> vertex{};
  int count = 0;
};

/// pos_clip finite. The polygon keeps the triangle's orientation.
ClipPolygon clip_triangle(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                          const ClipDistances& distances = {});

/// The same of a line between the first two vertices: two corners, or none.
ClipPolygon clip_line(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                      const ClipDistances& distances);

/// The corner in window coordinates, snapped. Like a vertex's, its depth (and its varyings) stay those of the place before
/// snapping, at most 1/512 px away in x and in y.
ScreenVertex project_corner(const Viewport& viewport, const glm::dvec4& pos_clip);

/// Corner c's varyings: smooth and linear ones interpolated, flat ones the provoking vertex's. rows are the varyings
/// of the three vertices, w their clip-space w.
void interpolate_corner(const ClipCorner& c, const std::array<double, 3>& w, const std::array<const float*, 3>& rows, int provoking,
                        const ShaderKernels& kernels, float* out);

/// Twice the area of three corners: > 0 where they turn left.
inline int64_t orient2d(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  return int64_t{b.x - a.x} * (c.y - a.y) - int64_t{b.y - a.y} * (c.x - a.x);
}

/// How a clipped polygon becomes a fan of triangles.
///
/// Snapping can bend a nearly straight corner inwards; a fan from elsewhere would turn a piece over and draw its samples
/// twice. From `apex` all pieces turn one way. Where the outline of a sliver crosses itself there is no such corner; then
/// pieces that turn against the whole are left out, and their samples remain drawn by the others.
struct Fan {
  uint32_t apex = 0;
  bool counter_clockwise = false;
};

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

}  // namespace halfspace
