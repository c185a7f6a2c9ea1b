// SPDX-License-Identifier: Apache-2.0
//
// Blinn-Phong per pixel with one point light and one colour map.
//
//   colour = texture · (ambient + diffuse · max(n·l, 0)) + specular · max(n·h, 0)^shininess,  h = (l + v) / |l + v|
//
// J. F. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977. No highlight where the
// light is behind the surface.
#pragma once

#include "core/lane_math.h"
#include "shading/contract.h"
#include "shading/texture.h"

namespace halfspace {

struct BlinnPhong {
  glm::mat4 clip_from_world;
  glm::mat4 world_from_object;
  glm::mat3 normal_from_object;  ///< inverse transpose of world_from_object's upper left 3x3
  glm::vec3 light_ws;            ///< position
  glm::vec3 eye_ws;              ///< position
  const Texture2D* albedo;       ///< linear colour; not owned
  Sampler sampler;
  float ambient;
  float diffuse;
  float specular;
  float shininess;  ///< ≥ 0

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec3<R> normal_os;
    vec2<R> uv;
  };

  template <class R>
  struct Varyings {
    vec3<R> position_ws;
    vec3<R> normal_ws;
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position_ws = world_from_object * vec4<R>(in.position_os, R(1));
    out.position_ws = vec3<R>(position_ws);
    out.normal_ws = normal_from_object * in.normal_os;
    out.uv = in.uv;
    return clip_from_world * position_ws;
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> n = normalize(in.normal_ws);
    const vec3<R> l = normalize(light_ws - in.position_ws);
    const vec3<R> v = normalize(eye_ws - in.position_ws);
    const vec3<R> h = normalize(l + v);
    const R n_l = dot(n, l);
    const R lit = max(n_l, R(0));
    const R highlight = select(n_l > R(0), pow(max(dot(n, h), R(0)), R(shininess)), R(0));
    const vec4<R> texel = albedo->sample(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
    const vec3<R> color = vec3<R>(texel) * (R(ambient) + R(diffuse) * lit) + vec3<R>(R(specular) * highlight);
    return {vec4<R>(color, R(1))};
  }
};

}  // namespace halfspace
