// SPDX-License-Identifier: Apache-2.0
//
// Computes the values of shading/values/frame_values.h for spheres. Each sphere is an instance without triangles.
#pragma once

#include "halfspace/shading/sphere/sphere_impostor.h"
#include "halfspace/shading/values/frame_values.h"

namespace halfspace::HS_LANES {

/// Has the attributes, coverage and depth of SphereImpostor. Positions on exact spheres are on the ray of the pixel. Those on classic
/// sprites are on the hemisphere that they show, which differs from the depth that they write.
template <bool exact>
struct SphereValueShader : SphereImpostor<exact> {
  FrameCamera camera{};
  int32_t object = 0;

  template <class R>
  using Varyings = typename SphereImpostor<exact>::template Varyings<R>;

  template <class R>
  FrameResult<DepthTypedFragment, R> fragment(const Varyings<R>& in, const PrimitiveId<R>& id, const Pixel<R>& px) const {
    const SphereIntersection& rays = this->lens;
    const SphereHit<R> h = this->hit(in, px);
    vec3<R> position_cs = in.center_cs.value + h.n_cs * in.radius.value;
    if constexpr (exact) {
      const R scale = rays.perspective ? h.t : R(1);
      position_cs = vec3<R>(rays.ray_x.at(px.x).high * scale, rays.ray_y.at(px.y).high * scale, h.t);
    }
    const glm::mat3& world = this->world_from_camera;
    const SurfaceValues<R> values{world * position_cs, world * h.n_cs, in.color.value, vec2<R>(R(0)),
                                  IntOf<R>(object),    id.primitive,   IntOf<R>(0),    id.barycentrics};
    return {frame_values<R>(camera, values), h.seen, rays.window_depth(h.t, h.t_low)};
  }
};

}  // namespace halfspace::HS_LANES
