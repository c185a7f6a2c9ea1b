// SPDX-License-Identifier: Apache-2.0
//
// Lighting at a point of a surface. One function serves all shading rates (per triangle, per vertex or per pixel; see
// shading/surface/surface_shader.h). Diffuse and specular light are returned separately, so that the maps of a surface can be applied at a
// finer rate than lighting.
//
//   diffuse  = Σ sᵢ·dᵢ · max(n·lᵢ, 0)
//   specular = Σ sᵢ·gᵢ · c^shininess where n·lᵢ > 0, c = max(rᵢ·v, 0) (Phong) or max(n·hᵢ, 0) (Blinn-Phong)
//
// where dᵢ and gᵢ are the diffuse and specular color of light i, lᵢ is the unit vector towards it, v is the unit vector towards the
// eye, sᵢ is the incident strength of the light, rᵢ = 2(n·lᵢ)n − lᵢ and hᵢ = (lᵢ + v) / |lᵢ + v|.
// B. T. Phong, "Illumination for computer generated pictures", CACM 1975; J. F. Blinn, "Models of light reflection for computer
// synthesized pictures", SIGGRAPH 1977.
#pragma once

#include <cstdint>
#include <limits>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/light/light_set.h"
#include "halfspace/shading/shadow/shadow.h"

namespace halfspace::HS_LANES {

/// Lower limit of the attenuation denominator, which keeps the strength finite close to a light.
inline constexpr float kMinAttenuation = 1e-12f;

/// Returns v divided by its length. The zero vector stays zero.
template <class R>
HS_INLINE vec3<R> normalize_or_zero(const vec3<R>& v) {
  const R squared = dot(v, v);
  return v * select(squared > R(0) && squared < R(std::numeric_limits<float>::infinity()), inverse_sqrt(squared), R(0));
}

/// Normalizes a normal of any length and flips it to the side of v. The zero vector stays zero.
template <class R>
HS_INLINE vec3<R> face_towards(const vec3<R>& normal, const vec3<R>& v) {
  const vec3<R> n = normalize_or_zero(normal);
  return n * select(dot(n, v) >= R(0), R(1), R(-1));
}

/// The surface point to be lit.
template <class R>
struct SurfacePoint {
  vec3<R> position_rws;
  vec3<R> n_ws;  ///< unit normal; a point with a zero or NaN normal receives no light
  vec3<R> v_ws;  ///< unit vector towards the eye
  // Used only for shadows; may be left unset if no light has one.
  vec3<R> face_ws{};        ///< unit normal of the triangle, on the visible side
  R x_px{0}, y_px{0};       ///< window coordinates
  vec3<R> smooth_ws{R(0)};  ///< n_ws without the detail of a normal map; zero: the same as n_ws
  R smooth_height{0};       ///< height of the smooth surface above the triangle (shading/shadow/terminator.h)
};

template <class R>
HS_INLINE ShadowReceiver<R> shadow_receiver(const SurfacePoint<R>& p, const vec3<R>& l_ws) {
  return {p.position_rws, p.face_ws, p.n_ws, l_ws, p.x_px, p.y_px, p.smooth_ws, p.smooth_height};
}

/// The light that a source sends to a point, before shadowing.
template <class R>
struct IncidentLight {
  vec3<R> l_ws;  ///< unit vector towards the light
  R strength;    ///< incident strength: the product of all factors between light and point
};

template <class R>
HS_INLINE IncidentLight<R> light_at(const Light& light, const vec3<R>& position_rws) {
  if (light.type == LightType::directional) return {vec3<R>(light.position_rws), R(1)};
  const vec3<R> to_light = light.position_rws - position_rws;
  const R d = sqrt(dot(to_light, to_light));
  const vec3<R> l_ws = normalize_or_zero(to_light);
  const R attenuation = fma(R(light.attenuation.z) * d + R(light.attenuation.y), d, R(light.attenuation.x));
  R strength = R(1) / max(attenuation, R(kMinAttenuation));
  if (light.inverse_range > 0.0f) {  // the window that KHR_lights_punctual recommends: clamp(1 − (d / range)⁴, 0, 1)
    const R t = min(d * R(light.inverse_range), R(1)), t2 = t * t;
    strength *= R(1) - t2 * t2;
  }
  if (light.type == LightType::spot) {
    const R t = clamp((dot(l_ws, light.axis_ws) - R(light.cos_outer)) * R(light.cone_scale), R(0), R(1));
    strength *= t * t;  // the falloff that KHR_lights_punctual recommends
  }
  return {l_ws, strength};
}

/// Returns the cosine that is raised to the power of the shininess for the specular highlight, clamped to [0, 1].
template <class R>
HS_INLINE R highlight_cosine(LightModel model, const SurfacePoint<R>& p, const vec3<R>& l_ws, R n_l) {
  const R c = model == LightModel::phong ? fma(R(2) * n_l, dot(p.n_ws, p.v_ws), -dot(l_ws, p.v_ws))  // r·v
                                         : dot(p.n_ws, normalize_or_zero(l_ws + p.v_ws));
  return clamp(c, R(0), R(1));
}

/// Light received at a point, as linear colors.
template <class R>
struct Illumination {
  vec3<R> diffuse, specular;
};

/// Returns the light of the given sources at p. shininess must not be negative; at 0, the highlight is 1 wherever the surface faces the
/// light. lambert computes no specular light. The result is never NaN.
template <class R>
HS_INLINE Illumination<R> illuminate(const LightRange& lights, LightModel model, R shininess, const SurfacePoint<R>& p) {
  Illumination<R> sum{vec3<R>(R(0)), vec3<R>(R(0))};
  for (const Light& light : lights) {
    IncidentLight<R> arriving = light_at(light, p.position_rws);
    if (none(arriving.strength > R(0))) continue;
    const R n_l = dot(p.n_ws, arriving.l_ws);
    if (light.shadow != nullptr && any(n_l > R(0)))  // skip the lookup if no lane faces the light
      arriving.strength *= shadow_factor(*light.shadow, shadow_receiver(p, arriving.l_ws));
    sum.diffuse += light.diffuse * (max(n_l, R(0)) * arriving.strength);
    if (model == LightModel::lambert) continue;
    const R highlight = unit_pow(highlight_cosine(model, p, arriving.l_ws, n_l), shininess);
    sum.specular += light.specular * select(n_l > R(0), highlight * arriving.strength, R(0));
  }
  return sum;
}

}  // namespace halfspace::HS_LANES
