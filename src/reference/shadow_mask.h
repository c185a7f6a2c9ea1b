// SPDX-License-Identifier: Apache-2.0
//
// The shader of `halfspace validate`. Instead of a color, it writes the index of the visible triangle, the orientation of the surface to
// one light, and the result of that light's shadow map lookup.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/lighting.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Output: (fraction of the light that arrives according to the shadow map, or 1 without a map; dot product of shading normal and light
/// direction; 1 + mesh; triangle).
struct ShadowMask {
  glm::mat4 clip_from_object;
  glm::mat4 world_from_object;   ///< to world space relative to the eye
  glm::mat3 normal_from_object;  ///< inverse transpose of the above
  glm::vec3 to_eye_ws{0.0f};     ///< orthographic projection: unit vector towards the eye; otherwise 0
  Light light;
  float mesh = 0.0f;

  template <class R>
  struct Attributes {
    vec3<R> position_os, normal_os;
    R triangle;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_rws, normal_ws;
    Flat<R> triangle;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position_os(in.position_os, R(1));
    out.position_rws = vec3<R>(world_from_object * position_os);
    out.normal_ws = normal_from_object * in.normal_os;
    out.triangle.value = in.triangle;
    return clip_from_object * position_os;
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> v_ws = to_eye_ws == glm::vec3(0.0f) ? normalize_or_zero(-in.position_rws) : vec3<R>(to_eye_ws);
    const vec3<R> face_ws = face_towards(cross(px.ddx(&Varyings<R>::position_rws), px.ddy(&Varyings<R>::position_rws)), v_ws);
    const vec3<R> n_ws = normalize_or_zero(in.normal_ws) * select(px.front_facing, R(1), R(-1));
    const vec3<R> l_ws = light_at(light, in.position_rws).l_ws;
    const ShadowReceiver<R> receiver{in.position_rws, face_ws, n_ws, l_ws, px.x, px.y};
    const R arriving = light.shadow == nullptr ? R(1) : shadow_factor(*light.shadow, receiver);
    return {vec4<R>(arriving, dot(n_ws, l_ws), R(mesh + 1.0f), in.triangle.value)};
  }
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
