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

#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace {

/// A triangle cut by n planes has at most 3 + n corners in exact arithmetic; rounding can bend an edge, and cut it twice.
inline constexpr int kFixedPlanes = 7;
inline constexpr int kClipPlanes = kFixedPlanes + 8;
inline constexpr int kMaxCorners = 3 + 2 * kClipPlanes;
/// Corners of what is left of a triangle cut by the fixed planes and that many clip distances.
constexpr int most_corners(int clip_distances) { return 3 + 2 * (kFixedPlanes + clip_distances); }

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

}  // namespace halfspace
