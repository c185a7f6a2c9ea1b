// SPDX-License-Identifier: Apache-2.0
//
// The shader for a surface that is invisible except for the shadows on it. It is blended over the background.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/surface/surface_uniforms.h"

namespace halfspace::HS_LANES {

struct ShadowCatcher : SurfaceUniforms {
  float strength = 0.6f;        ///< opacity of a full shadow
  float inverse_radius = 1.0f;  ///< shadows fade out towards this distance from the origin of the object, in object space

  template <class R>
  struct Attributes {
    vec3<R> position_os;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_os, position_rws;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_os = in.position_os;
    out.position_rws = position_rws(in.position_os);
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    const vec3<R> v_ws = to_eye(in.position_rws);
    const vec3<R> n_ws = face_towards(cross(px.ddx(&V::position_rws), px.ddy(&V::position_rws)), v_ws);
    R lit(1e-6f), whole(1e-6f);  // not 0, so that a point without any light counts as lit
    for (const Light& light : lights.at_pixel(px.x, px.y)) {
      const IncidentLight<R> arriving = light_at(light, in.position_rws);
      const R share =
          arriving.strength * max(dot(n_ws, arriving.l_ws), R(0)) * R(max(light.diffuse.x, max(light.diffuse.y, light.diffuse.z)));
      whole += share;
      if (light.shadow == nullptr || none(share > R(0))) {
        lit += share;
      } else {
        lit += share * shadow_factor(*light.shadow, ShadowReceiver<R>{in.position_rws, n_ws, n_ws, arriving.l_ws, px.x, px.y});
      }
    }
    const R distance = sqrt(dot(in.position_os, in.position_os)) * R(inverse_radius);
    const R fade = clamp(R(2) - R(2) * distance, R(0), R(1));
    return {vec4<R>(R(0), R(0), R(0), clamp(R(1) - lit / whole, R(0), R(1)) * fade * R(strength))};
  }
};

}  // namespace halfspace::HS_LANES
