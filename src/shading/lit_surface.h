// SPDX-License-Identifier: Apache-2.0
//
// What the shaders of lit surfaces have in common: where the surface stands, what it looks like, what light falls on it.
#pragma once

#include "shading/lighting.h"
#include "shading/texture.h"

namespace halfspace {

/// Uniforms, to be inherited by a shader.
struct LitSurface {
  glm::mat4 clip_from_object;
  glm::mat4 world_from_object;    ///< to the world's axes round the eye (_ew, see Light)
  glm::mat3 normal_from_object;   ///< inverse transpose of world_from_object's upper left 3x3
  glm::vec3 to_eye_ws{0.0f};      ///< unit vector towards the eye where that is the same everywhere (orthographic); else 0
  std::span<const Light> lights;  ///< not owned
  bool two_sided = false;         ///< back faces are lit by the turned normal
  Reflectance surface;
  glm::vec3 color{1.0f};           ///< linear; the map's factor where there is one
  const Texture2D* map = nullptr;  ///< linear colour; not owned
  Sampler sampler{};

  /// The surface's colour at uv, for a pixel whose steps to the right and up change uv by duv_dx and duv_dy.
  template <class R>
  HS_INLINE vec3<R> albedo_at(const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
    if (map == nullptr) return vec3<R>(color);
    return color * vec3<R>(map->sample(sampler, uv, duv_dx, duv_dy));
  }

  /// The light that a point sends to the eye. normal_ws has any length.
  template <class R>
  HS_INLINE vec4<R> lit(const vec3<R>& albedo, const vec3<R>& normal_ws, const vec3<R>& position_ew, MaskOf<R> front_facing) const {
    vec3<R> n_ws = normalize_or_zero(normal_ws);
    if (two_sided) n_ws = n_ws * select(front_facing, R(1), R(-1));
    const vec3<R> v_ws = to_eye_ws == glm::vec3(0.0f) ? normalize_or_zero(-position_ew) : vec3<R>(to_eye_ws);
    return vec4<R>(blinn_phong(lights, surface, albedo, n_ws, v_ws, position_ew), R(1));
  }
};

}  // namespace halfspace
