// SPDX-License-Identifier: Apache-2.0
//
// An environment as background, drawn as one triangle that covers the target behind everything else. A night sky can have
// procedural stars (star_sky.h) in addition to its map. They are as sharp as the render target allows, and fade at the horizon.
#pragma once

#include "halfspace/core/lane_math.h"
#include "halfspace/shading/contract.h"
#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/environment/star_sky.h"

namespace halfspace::HS_LANES {

struct EnvironmentSky {
  glm::vec3 forward_ws{0, 0, -1};  ///< direction through the center of the image: a unit vector in a symmetric view
  glm::vec3 right_ws{1, 0, 0};     ///< unit vector times the tangent of half the horizontal field of view
  glm::vec3 up_ws{0, 1, 0};        ///< unit vector times the tangent of half the vertical field of view
  EnvironmentBlend environment;
  StarSky first_stars{.density = 0.0f}, second_stars{.density = 0.0f};  ///< stars of the two environments; density 0 means none

  template <class R>
  struct Attributes {
    vec2<R> corner;  ///< NDC
  };
  template <class R>
  struct Varyings {
    vec3<R> ray_ws;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.ray_ws = forward_ws + right_ws * in.corner.x + up_ws * in.corner.y;
    return vec4<R>(in.corner, R(0), R(1));  // reversed Z: 0 is the far plane
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    vec3<R> light = environment.light(in.ray_ws, px.ddx(&Varyings<R>::ray_ws), px.ddy(&Varyings<R>::ray_ws));
    const float weight = environment.weight;
    if (first_stars.density > 0.0f && weight < 1.0f) light += star_light(first_stars, environment.first, in.ray_ws) * R(1.0f - weight);
    if (second_stars.density > 0.0f && weight > 0.0f) light += star_light(second_stars, environment.second, in.ray_ws) * R(weight);
    return {vec4<R>(light, R(1))};
  }

  /// Returns the light of an environment's stars from direction d_ws. Stars are dimmed below an altitude of 12 degrees.
  template <class R>
  static vec3<R> star_light(const StarSky& stars, const Environment& sky, const vec3<R>& d_ws) {
    const vec3<R> d_ms = sky.map_from_world * d_ws;
    const vec3<R> d = d_ms * inverse_sqrt(dot(d_ms, d_ms));
    return stars.star_light(d) * (clamp(d.y * R(5.0f), 0.0f, 1.0f) * R(sky.brightness));
  }
};

}  // namespace halfspace::HS_LANES
