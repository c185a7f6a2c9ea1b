// SPDX-License-Identifier: Apache-2.0
//
// A surface of one colour, or of one colour map, lit per pixel.
#pragma once

#include "shading/contract.h"
#include "shading/lit_surface.h"

namespace halfspace {

struct BlinnPhong : LitSurface {
  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec3<R> normal_os;
    vec2<R> uv;
  };

  template <class R>
  struct Varyings {
    vec3<R> position_ew;
    vec3<R> normal_ws;
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position_os(in.position_os, R(1));
    out.position_ew = vec3<R>(world_from_object * position_os);
    out.normal_ws = normal_from_object * in.normal_os;
    out.uv = in.uv;
    return clip_from_object * position_os;
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> albedo = albedo_at(in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
    return {lit(albedo, in.normal_ws, in.position_ew, px.front_facing)};
  }
};

}  // namespace halfspace
