// SPDX-License-Identifier: Apache-2.0
//
// The faces of cube maps (OpenGL 4.6, section 8.13, table 8.19), numbered +x −x +y −y +z −z, and the texels beyond their edges.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/texture/footprint.h"

namespace halfspace::HS_LANES::detail {

/// A vector in the coordinates of a cube face: along s, along t, and outward. T is a type of reals or of integers.
template <class T>
struct OnFace {
  T s, t, out;
};

/// A cube face per lane. sign: 1 or −1.
template <class T, class M>
struct CubeFace {
  M is_x, is_y;
  T sign;

  /// Returns the coordinates of a vector of map space.
  HS_INLINE OnFace<T> operator()(const T& vx, const T& vy, const T& vz) const {
    const T x = sign * vx, y = sign * vy, z = sign * vz;
    return {select(is_x, -z, select(is_y, vx, x)), select(is_y, z, -vy), select(is_x, x, select(is_y, y, z))};
  }
  /// The inverse.
  HS_INLINE std::array<T, 3> to_map(const OnFace<T>& v) const {
    const T out = sign * v.out;
    return {select(is_x, out, select(is_y, v.s, sign * v.s)), select(is_y, out, -v.t),
            select(is_x, -(sign * v.s), select(is_y, sign * v.t, out))};
  }
};

/// A face number, and coordinates in it in [0, 1].
template <class R>
struct CubeCoordinates {
  IntOf<R> face;
  vec2<R> st;
  R lod;  ///< from the derivatives, before bias and limits
};

/// Returns where a direction meets the cube. n: texels along the edge of level 0. dx and dy: the changes in the direction to the next pixel
/// to the right and to the next pixel up. A direction of 0 gives NaN coordinates.
template <class R>
HS_INLINE CubeCoordinates<R> cube_coordinates(int n, const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) {
  CubeFace<R, MaskOf<R>> face;
  face.is_x = abs(d.x) >= abs(d.y) && abs(d.x) >= abs(d.z);
  face.is_y = !face.is_x && abs(d.y) >= abs(d.z);
  const MaskOf<R> negative = select(face.is_x, d.x, select(face.is_y, d.y, d.z)) < R(0.0f);
  face.sign = select(negative, R(-1.0f), R(1.0f));
  const OnFace<R> at = face(d.x, d.y, d.z), x = face(dx.x, dx.y, dx.z), y = face(dy.x, dy.y, dy.z);
  const R inverse = R(1.0f) / at.out, s = at.s * inverse, t = at.t * inverse;
  const R half_inverse = R(0.5f) * inverse;  // faces are 2 wide
  const vec2<R> dst_dx((x.s - s * x.out) * half_inverse, (x.t - t * x.out) * half_inverse);
  const vec2<R> dst_dy((y.s - s * y.out) * half_inverse, (y.t - t * y.out) * half_inverse);
  const IntOf<R> axis = select(face.is_x, IntOf<R>(0), select(face.is_y, IntOf<R>(2), IntOf<R>(4)));
  return {axis + select(negative, IntOf<R>(1), IntOf<R>(0)), vec2<R>(fma(s, R(0.5f), R(0.5f)), fma(t, R(0.5f), R(0.5f))),
          level_of_detail(n, n, dst_dx, dst_dy)};
}

/// A texel of a cube.
template <class I>
struct CubeTexel {
  I face, x, y;
};

/// Returns the texel at (x, y) of a face of n x n texels, or, where exactly one of x and y is −1 or n, the texel of the adjacent face that
/// shares this part of the edge.
template <class R>
HS_INLINE CubeTexel<IntOf<R>> cube_texel(IntOf<R> face, IntOf<R> x, IntOf<R> y, int n) {
  using I = IntOf<R>;
  const I zero(0), last(n - 1);
  const MaskOf<R> left = x<zero, right = x> last, low = y<zero, high = y> last;
  const MaskOf<R> outside = left || right || low || high;
  if (!any(outside)) return {face, x, y};
  // Twice the distance from the center of the cube, in texels: texel centers are odd numbers apart from n, and the faces are at ±n. The
  // point next to the edge has n along its own axis and n − 1 outward.
  const CubeFace<I, MaskOf<R>> from{face < I(2), face >= I(2) && face < I(4), select((face & I(1)) != zero, I(-1), I(1))};
  const I edge(n), centre(1 - n);
  const I s = select(left, -edge, select(right, edge, x + x + centre)), t = select(low, -edge, select(high, edge, y + y + centre));
  const std::array<I, 3> p = from.to_map({s, t, select(outside, I(n - 1), edge)});
  const auto is_face = [&](const I& v) { return v == edge || v == -edge; };
  CubeFace<I, MaskOf<R>> to;
  to.is_x = is_face(p[0]);
  to.is_y = !to.is_x && is_face(p[1]);
  const MaskOf<R> negative = select(to.is_x, p[0], select(to.is_y, p[1], p[2])) < zero;
  to.sign = select(negative, I(-1), I(1));
  const OnFace<I> at = to(p[0], p[1], p[2]);
  const I axis = select(to.is_x, zero, select(to.is_y, I(2), I(4)));
  const auto index = [&](const I& v) { return min(max(I((v - centre) >> 1), zero), last); };
  return {select(outside, axis + select(negative, I(1), zero), face), select(outside, index(at.s), x), select(outside, index(at.t), y)};
}

}  // namespace halfspace::HS_LANES::detail
