// SPDX-License-Identifier: Apache-2.0
//
// Projects points into shadow maps.
#pragma once

#include <type_traits>

#include "halfspace/core/lane_math.h"
#include "halfspace/shading/shadow/shadow_map.h"
#include "halfspace/shading/texture/map_row.h"

namespace halfspace::HS_LANES {

/// A point in a shadow view. Texel coordinates start at the lower left corner; texel i covers [i, i + 1].
template <class R>
struct ShadowCoordinates {
  R x, y;                ///< in texels
  R depth;               ///< reversed window depth
  R w;                   ///< clip w: distance along the axis, or 1
  R depth_dx, depth_dy;  ///< change in depth per texel on the plane that texels are compared with; 0: no plane
};

/// Returns the change in window depth, at clip w, when a point moves along the view axis by the width of a texel. In a perspective view,
/// the window depth is a/w + b.
template <class R>
HS_INLINE R depth_of_texel(const ShadowView& view, R w) {
  return R(view.texel_per_w * view.depth_per_unit) / w;
}

template <class R>
HS_INLINE ShadowCoordinates<R> shadow_coordinates(const ShadowView& view, const vec3<R>& position_rws) {
  const vec4<R> p = view.clip_from_rws * vec4<R>(position_rws, R(1));
  const R inverse = R(1) / p.w;
  const R half(0.5f * static_cast<float>(view.size));
  return {fma(p.x * inverse, half, half), fma(p.y * inverse, half, half), p.z * inverse, p.w, R(0), R(0)};
}

/// Returns whether the view contains the point and `margin` texels around it. Points beyond the far plane are not contained.
template <class R>
HS_INLINE MaskOf<R> holds(const ShadowView& view, const ShadowCoordinates<R>& p, float margin) {
  const R low(margin), high(static_cast<float>(view.size) - margin);
  return p.w > R(0) && p.x >= low && p.x <= high && p.y >= low && p.y <= high && p.depth >= R(0) && p.depth <= R(1);
}

/// Sets the depth slopes of p from the plane through position_rws with the given normal. A plane in world space is also a plane in
/// window space, so the slopes are the same at every texel. They are limited to max_slope times the depth of a texel.
template <class R>
HS_INLINE void set_plane(const ShadowView& view, const vec3<R>& position_rws, const vec3<R>& normal_ws, std::type_identity_t<R> max_slope,
                         ShadowCoordinates<R>& p) {
  const vec4<R> plane = view.clip_plane_from_rws * vec4<R>(normal_ws, -dot(normal_ws, position_rws));
  const R per_texel(2.0f / static_cast<float>(view.size));
  const R limit = depth_of_texel(view, p.w) * max_slope;
  const R scale = select(plane.z != R(0), -per_texel / plane.z, R(0));
  p.depth_dx = clamp(plane.x * scale, -limit, limit);
  p.depth_dy = clamp(plane.y * scale, -limit, limit);
}

namespace detail {

/// Returns the row index in memory of texel row j. Rows outside the map are clamped.
template <class R>
HS_INLINE IntOf<R> row_of(const ShadowView& view, IntOf<R> j) {
  const IntOf<R> last(view.size - 1);
  return last - min(max(j, IntOf<R>(0)), last);
}

/// Returns 1 if texel (i, j), which has the depth `nearest`, does not occlude the point, and 0 if it does.
template <class R>
HS_INLINE R lit(const ShadowCoordinates<R>& p, IntOf<R> i, IntOf<R> j, R nearest) {
  const R dx = to_real<R>(i) + R(0.5f) - p.x, dy = to_real<R>(j) + R(0.5f) - p.y;
  const R depth = fma(p.depth_dy, dy, fma(p.depth_dx, dx, p.depth));
  return select(max(depth, R(0)) >= nearest, R(1), R(0));
}

}  // namespace detail

/// Returns the depth of texel (i, j). Coordinates outside the map are clamped.
template <class R>
HS_INLINE R map_depth(const ShadowView& view, IntOf<R> i, IntOf<R> j) {
  const IntOf<R> column = min(max(i, IntOf<R>(0)), IntOf<R>(view.size - 1));
  return R(gather(view.depth, IntOf<R>(detail::row_of<R>(view, j) * IntOf<R>(view.size) + column)));
}

/// Returns 1 if texel (i, j) does not occlude the point, and 0 if it does. An empty texel has depth 0 and never occludes, even if
/// the plane of the point extends beyond the far plane of the view.
template <class R>
HS_INLINE R lit_by_texel(const ShadowView& view, const ShadowCoordinates<R>& p, IntOf<R> i, IntOf<R> j) {
  return detail::lit(p, i, j, map_depth<R>(view, i, j));
}

/// The same for texels (i, j), …, (i + N − 1, j), N up to 4.
template <int N, class R>
HS_INLINE std::array<R, N> lit_by_texels(const ShadowView& view, const ShadowCoordinates<R>& p, IntOf<R> i, IntOf<R> j) {
  std::array<R, N> texels = map_row<N, R>(view.depth, view.size, i, detail::row_of<R>(view, j));
  for (int n = 0; n < N; ++n) {
    R& texel = texels[static_cast<std::size_t>(n)];
    texel = detail::lit(p, IntOf<R>(i + IntOf<R>(n)), j, texel);
  }
  return texels;
}

}  // namespace halfspace::HS_LANES
