// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/contract.h"
#include "workload_shading.h"

namespace halfspace {

/// Points that look like spheres: the fragment finds the sphere's normal and depth. Eye space is the world moved.
struct PointShader {
  glm::mat4 clip_from_world;
  glm::vec3 eye_ws;
  float size_at_w1;        ///< px; of a sphere where clip w is 1
  float depth_a, depth_b;  ///< clip z = a·z + b of eye-space z
  float radius;
  glm::vec3 light_es{2.0f, 3.0f, 4.0f};

  template <class R>
  struct Attributes {
    vec3<R> position_ws;
  };
  template <class R>
  struct Varyings {
    Flat<vec3<R>> center_es, base;
  };

  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.center_es.value = in.position_ws - eye_ws;
    out.base.value = glm::vec3(0.5f) + in.position_ws * 0.5f;
    const vec4<R> clip = clip_from_world * vec4<R>(in.position_ws, R(1));
    return {clip, R(size_at_w1) / clip.w, {}};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Bump<R> bump = bump_at(in, px);
    const vec4<R> color = lit(in.base.value, phong(bump.n, unit(light_es - bump.position_es), unit(-bump.position_es)));
    return {color, bump.inside, depth_of(bump)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    const Bump<R> bump = bump_at(in, px);
    return {bump.inside, depth_of(bump)};
  }

 private:
  // Where the sphere is met, for a point seen from straight ahead.
  template <class R>
  struct Bump {
    vec3<R> n, position_es;
    MaskOf<R> inside;
  };
  template <class R>
  HS_INLINE Bump<R> bump_at(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> coord = px.point_coord();
    const R dx = R(2) * coord.x - R(1), dy = R(1) - R(2) * coord.y, squared = dx * dx + dy * dy;
    const vec3<R> n(dx, dy, sqrt(max(R(1) - squared, R(0))));
    return {n, in.center_es.value + n * radius, squared <= R(1)};
  }
  template <class R>
  HS_INLINE R depth_of(const Bump<R>& bump) const {
    const R z = bump.position_es.z;
    return R(0.5f) - R(0.5f) * ((R(depth_a) * z + R(depth_b)) / z);
  }
};

}  // namespace halfspace
