// SPDX-License-Identifier: Apache-2.0
//
// Shadow bias, which prevents self-shadowing. A shadow map stores one depth per texel, but the depth of the surface changes within the
// texel, by the width of the texel times the tangent of the angle of incidence. Each method either moves the point by about that much, or
// evaluates the depth of the surface at the center of each texel.
#pragma once

#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace::HS_LANES {

/// Returns the radius of the filter kernel in texels, over which the bias has to be sufficient.
inline float filter_reach(const ShadowSettings& s) {
  switch (s.filter) {
    case ShadowFilter::hard: return 0.5f;
    case ShadowFilter::bilinear: return 1.0f;
    case ShadowFilter::pcf3: return 2.0f;
    case ShadowFilter::pcf5: return 3.0f;
    case ShadowFilter::pcf7: return 4.0f;
    case ShadowFilter::pcss: return kMaxPenumbra + 0.5f;
    default: return s.radius + 0.5f;
  }
}

/// Moves the receiver along the face normal by `texels` times the sine of the angle of incidence, and projects it to the view.
template <class R>
HS_INLINE ShadowCoordinates<R> normal_offset_coordinates(const ShadowView& view, const ShadowReceiver<R>& at, R cosine, float texels) {
  const R w = shadow_coordinates(view, at.position_rws).w;
  const R step = R(texels * view.texel_per_w) * w * sqrt(R(1) - cosine * cosine);
  return shadow_coordinates(view, at.position_rws + at.face_normal_ws * step);
}

/// Returns the tangent of the angle with the given cosine, clamped to limit.
template <class R>
HS_INLINE R tangent_of(R cosine, float limit) {
  return min(sqrt(R(1) - cosine * cosine) / max(cosine, R(1e-6f)), R(limit));
}

/// Returns the offset in texels that ShadowBias::automatic applies. Within the triangle, its plane is sufficient. Neighboring triangles
/// deviate from that plane by an amount that grows with the radius of the filter and with the angle of incidence. Half a texel is added for
/// the rounding of depths within a texel. The radius is capped at the radius of pcf7: pcss reaches farther, but only for occluders that are
/// far away. tangent: of the angle between the light and the normal of the plane.
template <class R>
HS_INLINE R automatic_depth_offset(const ShadowSettings& s, R tangent) {
  return R(kAutomaticDepthOffset) * fma(R(1.0f + min(filter_reach(s), 4.0f)), tangent, R(1));
}

/// Projects the receiver to the view and applies ShadowBias::automatic. If the triangle faces the light, texels are compared with its
/// plane. Otherwise, they are compared with the smooth surface above it (shading/shadow/terminator.h): at its height, with the plane of its
/// normal.
///
/// At a grazing angle, a bias that depends on this angle alone moves the point over hundreds of texels and past the objects that shade it.
/// Where the shading normal is at a grazing angle as well, hardly any light is reflected. Where a normal map turns it to the light, the
/// point would be bright. The tangent is therefore limited by that of the shading normal. A triangle that faces the light needs more,
/// because it or the triangles next to it lean more than the surface: at least twice as much, and without a limit if no map turns the
/// normal towards the light.
template <class R>
HS_INLINE ShadowCoordinates<R> automatic_coordinates(const ShadowView& view, const ShadowSettings& s, const ShadowReceiver<R>& at) {
  const MaskOf<R> away = dot(at.face_normal_ws, at.to_light_ws) <= R(0);
  const vec3<R> smooth_ws = smooth_normal(at), normal_ws = select(away, smooth_ws, at.face_normal_ws);
  const vec3<R> position_rws = at.position_rws + smooth_ws * select(away, at.smooth_height, R(0));
  const R shading_l = clamp(dot(at.shading_normal_ws, at.to_light_ws), R(0), R(1)), smooth_l = dot(smooth_ws, at.to_light_ws);
  const R turned = clamp(R(1) - smooth_l / max(shading_l, R(1e-6f)), R(1e-3f), R(1));  // 0: no map, or it turns the normal away
  const R limit = tangent_of(shading_l, kSteepestSlope) * select(away, R(1), R(2) / turned);
  const R tangent = min(tangent_of(clamp(abs(dot(normal_ws, at.to_light_ws)), R(0), R(1)), kSteepestSlope), limit);

  ShadowCoordinates<R> p = shadow_coordinates(view, position_rws);
  set_plane(view, position_rws, normal_ws, clamp(R(2) * limit, R(1), R(kSteepestSlope)), p);
  p.depth += depth_of_texel(view, p.w) * automatic_depth_offset(s, tangent);
  return p;
}

/// Projects the receiver to the view and applies the bias of the settings.
template <class R>
HS_INLINE ShadowCoordinates<R> biased_coordinates(const ShadowView& view, const ShadowSettings& s, const ShadowReceiver<R>& at) {
  if (s.bias == ShadowBias::automatic) return automatic_coordinates(view, s, at);
  const R cosine = clamp(dot(at.face_normal_ws, at.to_light_ws), R(0), R(1));
  if (s.bias == ShadowBias::normal_offset) return normal_offset_coordinates(view, at, cosine, s.constant * filter_reach(s));

  ShadowCoordinates<R> p = shadow_coordinates(view, at.position_rws);
  const R texel = depth_of_texel(view, p.w);
  switch (s.bias) {
    case ShadowBias::constant: p.depth += texel * R(s.constant); break;
    case ShadowBias::slope: p.depth += texel * (R(s.slope * filter_reach(s)) * tangent_of(cosine, s.max_slope) + R(s.constant)); break;
    case ShadowBias::angle: p.depth += texel * max(R(s.slope) * (R(1) - cosine), R(s.constant)); break;
    case ShadowBias::original: p.depth += R(0.0005f); break;
    case ShadowBias::receiver_plane:
      set_plane(view, at.position_rws, at.face_normal_ws, R(s.max_slope), p);
      p.depth += texel * R(s.constant);
      break;
    case ShadowBias::adaptive:  // a ten-thousandth of the depth range of the view, in addition to the plane
      set_plane(view, at.position_rws, at.shading_normal_ws, R(s.max_slope), p);
      p.depth += R((view.far - view.near) * 1e-4f * view.depth_per_unit) / (p.w * p.w);
      break;
    default: break;
  }
  return p;
}

}  // namespace halfspace::HS_LANES
