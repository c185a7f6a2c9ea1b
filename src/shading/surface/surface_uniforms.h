// SPDX-License-Identifier: Apache-2.0
//
// The placement and the lights of a surface: uniforms that all shaders for lit surfaces share.
#pragma once

#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

/// Texture coordinates of a pixel. duv_dx and duv_dy are the changes in uv to the next pixel to the right and to the next pixel up.
template <class R>
struct MapCoordinates {
  vec2<R> uv, duv_dx, duv_dy;
};

/// Shaders inherit from this struct.
struct SurfaceUniforms {
  glm::mat4 clip_from_object;
  glm::mat4 world_from_object;   ///< to camera-relative world space (_rws, see Light)
  glm::mat3 normal_from_object;  ///< inverse transpose of the upper left 3x3 of world_from_object
  float handedness = 1.0f;       ///< −1 if world_from_object mirrors, otherwise 1
  glm::vec3 to_eye_ws{0.0f};     ///< orthographic: the constant unit vector towards the eye; perspective: 0
  LightSet lights;               ///< not owned
  bool shadowed = false;         ///< at least one light has a shadow
  bool two_sided = false;        ///< flip the normal of back faces for lighting

  template <class R>
  HS_INLINE vec3<R> position_rws(const vec3<R>& position_os) const {
    return vec3<R>(world_from_object * vec4<R>(position_os, R(1)));
  }

  template <class R>
  HS_INLINE vec3<R> to_eye(const vec3<R>& position_rws) const {
    return to_eye_ws == glm::vec3(0.0f) ? normalize_or_zero(-position_rws) : vec3<R>(to_eye_ws);
  }
};

}  // namespace halfspace::HS_LANES
