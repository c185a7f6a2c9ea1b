// SPDX-License-Identifier: Apache-2.0
//
// Light that falls on a point of a surface: one function for every rate at which it may be asked (shading/surface_shader.h:
// by triangle, by vertex, by pixel). It tells diffuse and specular light apart, so that a surface's maps may be
// applied finer than the light was computed.
//
//   diffuse  = Σ sᵢ·dᵢ · max(n·lᵢ, 0)
//   specular = Σ sᵢ·gᵢ · c^shininess where n·lᵢ > 0, c = max(rᵢ·v, 0) (Phong) or max(n·hᵢ, 0) (Blinn and Phong)
//
// with dᵢ and gᵢ the diffuse and specular colour of light i, lᵢ the unit vector towards it, v that towards the eye, sᵢ what
// arrives of the light, rᵢ = 2(n·lᵢ)n − lᵢ and hᵢ = (lᵢ + v) / |lᵢ + v|.
// B. T. Phong, "Illumination for computer generated pictures", CACM 1975; J. F. Blinn, "Models of light reflection for computer
// synthesized pictures", SIGGRAPH 1977.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/light_types.h"
#include "halfspace/shading/shadow.h"

namespace halfspace {

/// One light. Colours are linear, intensity included. The suffix _rws says: the world's axes, but the eye as origin, so that
/// floats are finest where the eye is.
struct Light {
  LightType type = LightType::directional;
  glm::vec3 place_rws{0, 0, 1};  ///< directional: unit vector towards the light; else its position
  glm::vec3 diffuse{1.0f};
  glm::vec3 specular{1.0f};
  glm::vec3 attenuation{1, 0, 0};  ///< terms a of 1 / (a0 + a1·d + a2·d²); (0, 0, 1) is the physical falloff
  glm::vec3 axis_ws{0, 0, 1};      ///< spot: unit vector from what it shines on to the light
  float cos_outer = 0.0f;          ///< spot: cosine of the angle to the axis from which on it is dark
  float cone_scale = 1.0f;         ///< spot: 1 / (cosine of the angle up to which it shines in full − cos_outer)
  const Shadow* shadow = nullptr;  ///< what keeps it from points; null: nothing. Not owned
};

/// What arrives nearer to a light than the distance at which its attenuation is 1 over this is held to it.
inline constexpr float kMinAttenuation = 1e-12f;

/// v over its length; the zero vector stays zero.
template <class R>
HS_INLINE vec3<R> normalize_or_zero(const vec3<R>& v) {
  const R squared = dot(v, v);
  return v * select(squared > R(0) && squared < R(std::numeric_limits<float>::infinity()), inverse_sqrt(squared), R(0));
}

/// A normal of any length as a unit vector on the side of v; the zero vector stays zero.
template <class R>
HS_INLINE vec3<R> face_towards(const vec3<R>& normal, const vec3<R>& v) {
  const vec3<R> n = normalize_or_zero(normal);
  return n * select(dot(n, v) >= R(0), R(1), R(-1));
}

/// The point of a surface that is lit.
template <class R>
struct SurfacePoint {
  vec3<R> position_rws;
  vec3<R> n_ws;  ///< unit normal; a zero or NaN one is in the dark
  vec3<R> v_ws;  ///< unit vector towards the eye
  // For shadows alone; where no light has one they may be anything.
  vec3<R> face_ws{};   ///< unit normal of the triangle, on the side that is seen
  R x_px{0}, y_px{0};  ///< window coordinates
};

/// A light as a point sees it.
template <class R>
struct IncidentLight {
  vec3<R> l_ws;  ///< unit vector towards the light
  R strength;    ///< what arrives of it: every factor between light and point is multiplied in here
};

template <class R>
HS_INLINE IncidentLight<R> light_at(const Light& light, const vec3<R>& position_rws) {
  if (light.type == LightType::directional) return {vec3<R>(light.place_rws), R(1)};
  const vec3<R> to_light = light.place_rws - position_rws;
  const R d = sqrt(dot(to_light, to_light));
  const vec3<R> l_ws = normalize_or_zero(to_light);
  const R attenuation = fma(R(light.attenuation.z) * d + R(light.attenuation.y), d, R(light.attenuation.x));
  R strength = R(1) / max(attenuation, R(kMinAttenuation));
  if (light.type == LightType::spot) {
    const R t = clamp((dot(l_ws, light.axis_ws) - R(light.cos_outer)) * R(light.cone_scale), R(0), R(1));
    strength *= t * t * (R(3) - R(2) * t);
  }
  return {l_ws, strength};
}

/// The cosine that a highlight is a power of, at most 1.
template <class R>
HS_INLINE R highlight_cosine(LightModel model, const SurfacePoint<R>& p, const vec3<R>& l_ws, R n_l) {
  const R c = model == LightModel::phong ? fma(R(2) * n_l, dot(p.n_ws, p.v_ws), -dot(l_ws, p.v_ws))  // r·v
                                         : dot(p.n_ws, normalize_or_zero(l_ws + p.v_ws));
  return clamp(c, R(0), R(1));
}

/// Light on a point, in linear colours.
template <class R>
struct Illumination {
  vec3<R> diffuse, specular;
};

/// What all lights do at p. shininess ≥ 0. A highlight that is no power at all (shininess 0) is 1 wherever the light is in
/// front; lambert gives no specular light and spends nothing on it. Never NaN.
template <class R>
HS_INLINE Illumination<R> illuminate(std::span<const Light> lights, LightModel model, R shininess, const SurfacePoint<R>& p) {
  Illumination<R> sum{vec3<R>(R(0)), vec3<R>(R(0))};
  for (const Light& light : lights) {
    IncidentLight<R> arriving = light_at(light, p.position_rws);
    const R n_l = dot(p.n_ws, arriving.l_ws);
    if (light.shadow != nullptr && any(n_l > R(0)))  // what faces away is dark without asking
      arriving.strength *=
          shadow_factor(*light.shadow, ShadowReceiver<R>{p.position_rws, p.face_ws, p.n_ws, arriving.l_ws, p.x_px, p.y_px});
    sum.diffuse += light.diffuse * (max(n_l, R(0)) * arriving.strength);
    if (model == LightModel::lambert) continue;
    const R highlight = unit_pow(highlight_cosine(model, p, arriving.l_ws, n_l), shininess);
    sum.specular += light.specular * select(n_l > R(0), highlight * arriving.strength, R(0));
  }
  return sum;
}

}  // namespace halfspace
