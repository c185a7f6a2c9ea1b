// SPDX-License-Identifier: Apache-2.0
//
// A sphere displaced along its normal, lit per pixel with the normal of the displaced surface.
//
// A vertex keeps its direction from the centre, so a pixel finds the sphere's normal n as the direction of its position;
// the map of slopes then tilts it, finer than the mesh does:
//   normal = n·(1 + g/r) − east·∂g/∂east − north·∂g/∂north
// (scene/height_field.h derives it).
#pragma once

#include "shading/contract.h"
#include "shading/lit_surface.h"

namespace halfspace {

struct DisplacedSphere : LitSurface {
  const Texture2D* slopes = nullptr;  ///< (∂g/∂east, ∂g/∂north, 1 + g/r) over (u, v); not owned
  Sampler slope_sampler{};

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec2<R> uv;
  };

  template <class R>
  struct Varyings {
    vec3<R> position_os;
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_os = in.position_os;
    out.uv = in.uv;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> duv_dx = px.ddx(&Varyings<R>::uv), duv_dy = px.ddy(&Varyings<R>::uv);
    const vec3<R> slope(slopes->sample(slope_sampler, in.uv, duv_dx, duv_dy));
    const vec3<R> normal_ws = normal_from_object * tilted(normalize_or_zero(in.position_os), slope);
    const vec3<R> position_ew(world_from_object * vec4<R>(in.position_os, R(1)));
    return {lit(albedo_at(in.uv, duv_dx, duv_dy), normal_ws, position_ew, px.front_facing)};
  }

  /// The displaced surface's normal (not of unit length) where the sphere's unit normal is n, y towards the north pole.
  /// At the poles themselves, which have no east, n.
  template <class R>
  static HS_INLINE vec3<R> tilted(const vec3<R>& n, const vec3<R>& slope) {
    const R ring = sqrt(fma(n.x, n.x, n.z * n.z));
    const R inverse = select(ring > R(0), R(1) / ring, R(0));
    const vec3<R> east(n.z * inverse, R(0), -n.x * inverse);
    const vec3<R> north(-n.y * n.x * inverse, ring, -n.y * n.z * inverse);
    return n * slope.z - east * slope.x - north * slope.y;
  }
};

}  // namespace halfspace
