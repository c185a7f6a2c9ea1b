// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "halfspace/shading/values/light_types.h"

namespace halfspace::HS_LANES {

struct Shadow;

/// A light source. Colors are linear and include the intensity. The suffix _rws denotes camera-relative world space: the axes of
/// the world with the eye as the origin, so that floats are most precise near the eye.
struct Light {
  LightType type = LightType::directional;
  glm::vec3 position_rws{0, 0, 1};  ///< directional: unit vector towards the light; otherwise its position
  glm::vec3 diffuse{1.0f};
  glm::vec3 specular{1.0f};
  glm::vec3 attenuation{1, 0, 0};  ///< coefficients a of 1 / (a0 + a1·d + a2·d²); (0, 0, 1) is the physical falloff
  glm::vec3 axis_ws{0, 0, 1};      ///< spot: unit vector from the lit scene towards the light
  float cos_outer = 0.0f;          ///< spot: cosine of the angle to the axis at which the light fades to zero
  float cone_scale = 1.0f;         ///< spot: 1 / (cosine of the angle up to which the light has full strength − cos_outer)
  float inverse_range = 0.0f;      ///< point, spot: 1 / distance at which the light has faded to zero; 0: unlimited
  const Shadow* shadow = nullptr;  ///< shadow of this light; null: none. Not owned
};

}  // namespace halfspace::HS_LANES
