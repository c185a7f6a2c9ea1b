// SPDX-License-Identifier: Apache-2.0
//
// Light near the terminator, where the triangles of a mesh, the smooth surface that its vertex normals describe, and the normals of a
// normal map disagree about which side the light is on.
//
// The smooth surface. On a smooth mesh, a triangle that faces away from the light can have a point whose interpolated normal faces it. The
// triangle itself is in shadow, but the intended surface is above it and lit. J. Hanika, "Hacking the shadow terminator", Ray Tracing Gems
// II (2021), chapter 4, therefore starts shadow rays above the triangle. Here, the height is that of the quadratic surface that passes
// through the vertices and has their slopes. With the barycentric weights b, the vertices p and their unit normals n, it is
//
//   h = 1/2 Σ_{i<j} b_i b_j (p_j − p_i)·(n_j − n_i).
//
// Along an edge that is a chord of a circle, this is the distance from the chord to the circle. A fragment shader knows the interpolated
// normal N = Σ b_i n_i and its derivatives, but not the vertices. Let the normal change by S·v over a step v in the plane. Since n_j − n_i
// = S (p_j − p_i), the length of N gives 1 − |N|² = Σ_{i<j} b_i b_j |S (p_j − p_i)|². If the surface bends equally in all directions, or in
// only one, h is this times trace(S) / (2 |S|²), where |S|² is the sum of the squares of the elements.
//
// Normal maps. A mapped normal can face a light that is below the surface. M. J.-Y. Chiang, Y. K. Li and B. Burley, "Taming the shadow
// terminator", SIGGRAPH talks 2019, fade the light by a smooth function of the ratio of the two cosines. With their function, relief that
// is lit at a grazing angle loses most of its light. Here, the light is full where the cosine of the smooth surface is at least a quarter
// of that of the mapped normal. docs/explanation/shadows.md compares both with other methods.
#pragma once

#include <array>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace halfspace::HS_LANES {

/// Returns the height of the smooth surface above a triangle, along its normal; 0 where the surface is below the triangle. n: the
/// interpolated unit normals of the vertices, not normalized. n_x, n_y, p_x and p_y: the changes of n and of the position per pixel along
/// two directions of the window.
template <class R>
HS_INLINE R smooth_height(const vec3<R>& n, const vec3<R>& n_x, const vec3<R>& n_y, const vec3<R>& p_x, const vec3<R>& p_y) {
  // The part of the step along y that is perpendicular to the step along x.
  const R xx = dot(p_x, p_x), share = dot(p_x, p_y) / max(xx, R(1e-37f));
  const vec3<R> across = p_y - p_x * share, n_across = n_y - n_x * share;
  const R yy = dot(across, across);
  const R trace = fma(yy, dot(n_x, p_x), xx * dot(n_across, across)), squares = fma(yy, dot(n_x, n_x), xx * dot(n_across, n_across));
  // The normals of flat meshes differ only by their rounding, so that no curvature can be computed from them.
  const R spread = max(R(1) - dot(n, n) - R(0x1p-20f), R(0));
  return select(squares > R(0), max(R(0.5f) * spread * trace / squares, R(0)), R(0));
}

/// The same from the vertices of the triangle and their unit normals, without assumptions about the curvature.
template <class R>
R smooth_height(const std::array<vec3<R>, 3>& p, const std::array<vec3<R>, 3>& n, const std::array<R, 3>& weights) {
  R sum(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    sum += weights[i] * weights[j] * dot(p[j] - p[i], n[j] - n[i]);
  }
  return max(R(0.5f) * sum, R(0));
}

/// Returns the fraction of the light that a normal map leaves: 1 if both cosines are equal, and 0 where the smooth surface faces away from
/// the light. smooth_l, shading_l: cosines of the angles of the interpolated and of the mapped normal to the light.
template <class R>
HS_INLINE R terminator_fraction(R smooth_l, R shading_l) {
  const R t = clamp(R(4) * smooth_l / max(shading_l, R(1e-6f)), R(0), R(1));
  return t * t * (R(3) - R(2) * t);
}

}  // namespace halfspace::HS_LANES
