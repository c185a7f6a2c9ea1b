// SPDX-License-Identifier: Apache-2.0
//
// Draws only the depth of spheres, for shadow maps.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/sphere/sphere_intersection.h"

namespace halfspace::HS_LANES {

/// Returns the rectangle that the sprite of a sphere covers, and its minimum depth.
template <class R>
HS_INLINE PointSpriteVertex<R> sphere_bounds(const SphereIntersection& lens, const vec3<R>& center_cs, R radius) {
  const SphereSpan<R> x = lens.span(center_cs, radius, 0), y = lens.span(center_cs, radius, 1);
  return {vec2<R>(x.low, y.low), vec2<R>(x.high, y.high), lens.window_depth(max(center_cs.z - radius, R(lens.near))),
          lens.in_depth(center_cs, radius)};
}

struct SphereDepth {
  SphereIntersection lens;

  template <class R>
  struct Attributes {
    vec3<R> center_cs;
    R radius;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> center_cs;
    Flat<R> radius;
  };

  template <class R>
  PointSpriteVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {{in.center_cs}, {in.radius}};
    return sphere_bounds(lens, in.center_cs, in.radius);
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    const SphereHit<R> h = lens.hit(in.center_cs.value, in.radius.value, px.x, px.y);
    return {h.seen, lens.window_depth(h.t, h.t_low)};
  }
  /// The color is not used, but shaders that write depth need a fragment function.
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Visibility<R> v = visibility(in, px);
    return {vec4<R>(R(0), R(0), R(0), R(0)), v.keep, v.depth};
  }
};

}  // namespace halfspace::HS_LANES
