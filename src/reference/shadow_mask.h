// SPDX-License-Identifier: Apache-2.0
//
// The shader of `halfspace validate`. Instead of a color, it writes the index of the visible triangle, the orientation of the surface to
// one light, and the result of that light's shadow map lookup.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/shadow/terminator.h"

namespace halfspace::HS_LANES {

/// Output: (fraction of the light that arrives according to the shadow map, or 1 without a map; dot product of shading normal and light
/// direction; 1 + mesh; triangle). Where the triangle faces away from the light, the fraction includes terminator_fraction.
struct ShadowMask {
  glm::mat4 clip_from_object;
  glm::mat4 world_from_object;   ///< to world space relative to the eye
  glm::mat3 normal_from_object;  ///< inverse transpose of the above
  glm::vec3 to_eye_ws{0.0f};     ///< orthographic projection: unit vector towards the eye; otherwise 0
  Light light;
  float mesh = 0.0f;
  /// Shading normals, top row first: width x height vectors, of which zero vectors stand for the interpolated normal. Null: none. Not
  /// owned.
  const float* shading_normals = nullptr;
  int width = 0, height = 0;  ///< of the image

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
    out.normal_ws = normalize_or_zero(normal_from_object * in.normal_os);
    out.triangle.value = in.triangle;
    return clip_from_object * position_os;
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    const vec3<R> v_ws = to_eye_ws == glm::vec3(0.0f) ? normalize_or_zero(-in.position_rws) : vec3<R>(to_eye_ws);
    const vec3<R> p_x = px.ddx(&V::position_rws), p_y = px.ddy(&V::position_rws), face_ws = face_towards(cross(p_x, p_y), v_ws);
    const R side = select(px.front_facing, R(1), R(-1));
    const vec3<R> smooth_ws = normalize_or_zero(in.normal_ws) * side, n_ws = shading_normal(px, smooth_ws);
    const vec3<R> l_ws = light_at(light, in.position_rws).l_ws;
    ShadowReceiver<R> receiver{in.position_rws, face_ws, n_ws, l_ws, px.x, px.y};
    receiver.smooth_normal_ws = select(dot(face_ws, l_ws) > R(0), n_ws, smooth_ws);
    receiver.smooth_height = smooth_height(in.normal_ws, px.ddx(&V::normal_ws) * side, px.ddy(&V::normal_ws) * side, p_x, p_y);
    const R arriving = light.shadow == nullptr ? R(1) : shadow_factor(*light.shadow, receiver);
    return {vec4<R>(arriving, dot(n_ws, l_ws), R(mesh + 1.0f), in.triangle.value)};
  }

 private:
  template <class R>
  vec3<R> shading_normal(const Pixel<R>& px, const vec3<R>& smooth_ws) const {
    if (shading_normals == nullptr) return smooth_ws;
    // Lanes that are not covered can be outside of the picture.
    const IntOf<R> x = truncate_to_int(clamp(px.x, R(0), R(static_cast<float>(width - 1))));
    const IntOf<R> y = truncate_to_int(clamp(px.y, R(0), R(static_cast<float>(height - 1))));
    const IntOf<R> first = ((IntOf<R>(height - 1) - y) * IntOf<R>(width) + x) * IntOf<R>(3);
    vec3<R> n;
    for (int k = 0; k < 3; ++k) n[k] = R(gather(shading_normals, IntOf<R>(first + IntOf<R>(k))));
    return select(dot(n, n) > R(0), n, smooth_ws);
  }
};

}  // namespace halfspace::HS_LANES
