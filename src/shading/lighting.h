// SPDX-License-Identifier: Apache-2.0
//
// Light that falls on a point of a surface, and what the surface sends back: Lambert's cosine law and a highlight by the
// half vector.
//
//   colour = albedo · (ambient + Σ aᵢ·cᵢ · diffuse · max(n·lᵢ, 0)) + Σ aᵢ·cᵢ · specular · max(n·hᵢ, 0)^shininess
//
// with cᵢ the colour of light i, aᵢ its attenuation at the point, lᵢ the unit vector towards it and hᵢ = (lᵢ + v) / |lᵢ + v|.
// J. F. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977.
#pragma once

#include <span>

#include "core/lane_math.h"
#include "core/vec.h"

namespace halfspace {

/// A directional light or, where is_point, a point light. Colours are linear, intensity included. The suffix _ew says: the
/// world's axes, but the eye as origin, so that floats are finest where the eye is.
struct Light {
  bool is_point = false;
  glm::vec3 place_ew{0, 0, 1};  ///< point: position; directional: unit vector towards the light
  glm::vec3 color{1.0f};
  glm::vec3 attenuation{1, 0, 0};  ///< point: constant, linear and quadratic term a in 1 / (a0 + a1·d + a2·d²)
};

/// How a surface answers to light; factors per channel, linear.
struct Reflectance {
  glm::vec3 ambient{0.0f};  ///< of the albedo, seen without any light: includes the scene's ambient light
  glm::vec3 diffuse{1.0f};
  glm::vec3 specular{0.0f};
  float shininess = 1.0f;  ///< ≥ 0
};

/// v over its length; the zero vector stays zero.
template <class R>
HS_INLINE vec3<R> normalize_or_zero(const vec3<R>& v) {
  const R squared = dot(v, v);
  return v * select(squared > R(0), R(1) / sqrt(squared), R(0));
}

/// The colour of a surface point towards the eye. n_ws and v_ws (towards the eye) have unit length. No highlight where the
/// light is behind the surface.
template <class R>
HS_INLINE vec3<R> blinn_phong(std::span<const Light> lights, const Reflectance& surface, const vec3<R>& albedo, const vec3<R>& n_ws,
                              const vec3<R>& v_ws, const vec3<R>& position_ew) {
  vec3<R> diffuse = vec3<R>(surface.ambient);
  vec3<R> specular(R(0));
  for (const Light& light : lights) {
    vec3<R> l(light.place_ew);
    R strength(1);
    if (light.is_point) {
      const vec3<R> to_light = light.place_ew - position_ew;
      const R distance = sqrt(dot(to_light, to_light));
      l = normalize_or_zero(to_light);
      strength = R(1) / fma(R(light.attenuation.z) * distance + R(light.attenuation.y), distance, R(light.attenuation.x));
    }
    const R n_l = dot(n_ws, l);
    const R cosine = max(n_l, R(0)) * strength;
    diffuse += surface.diffuse * light.color * cosine;
    if (surface.specular != glm::vec3(0.0f)) {  // nothing is spent on a highlight that no one sees
      const vec3<R> h = normalize_or_zero(l + v_ws);
      const R highlight = select(n_l > R(0), pow(max(dot(n_ws, h), R(0)), R(surface.shininess)) * strength, R(0));
      specular += surface.specular * light.color * highlight;
    }
  }
  return albedo * diffuse + specular;
}

}  // namespace halfspace
