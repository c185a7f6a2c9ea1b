// SPDX-License-Identifier: Apache-2.0
//
// Shadow bias, which prevents self-shadowing. A shadow map stores one depth per texel, but the depth of the surface changes within the
// texel, by the width of the texel times the tangent of the angle of incidence. Each method either moves the point by about that much, or
// evaluates the depth of the surface at the center of each texel.
#pragma once

#include "halfspace/shading/shadow_view.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

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
/// far away. tangent: of the angle between the light and the normal of the plane on the lit side. The offset of a triangle that faces away
/// from the light is therefore large only at grazing angles, as near the terminator of a smooth mesh, where the triangle is lit.
template <class R>
HS_INLINE R automatic_depth_offset(const ShadowSettings& s, R tangent) {
  return R(kAutomaticDepthOffset) * fma(R(1.0f + min(filter_reach(s), 4.0f)), tangent, R(1));
}

/// Projects the receiver to the view and applies the bias of the settings.
template <class R>
HS_INLINE ShadowCoordinates<R> biased_coordinates(const ShadowView& view, const ShadowSettings& s, const ShadowReceiver<R>& at) {
  const R towards = dot(at.face_normal_ws, at.to_light_ws), cosine = clamp(towards, R(0), R(1));
  if (s.bias == ShadowBias::normal_offset) return normal_offset_coordinates(view, at, cosine, s.constant * filter_reach(s));

  ShadowCoordinates<R> p = shadow_coordinates(view, at.position_rws);
  const R texel = depth_of_texel(view, p.w);
  switch (s.bias) {
    case ShadowBias::constant: p.depth += texel * R(s.constant); break;
    case ShadowBias::slope: p.depth += texel * (R(s.slope * filter_reach(s)) * tangent_of(cosine, s.max_slope) + R(s.constant)); break;
    case ShadowBias::angle: p.depth += texel * max(R(s.slope) * (R(1) - cosine), R(s.constant)); break;
    case ShadowBias::original: p.depth += R(0.0005f); break;
    case ShadowBias::receiver_plane:
      set_plane(view, at.position_rws, at.face_normal_ws, s.max_slope, p);
      p.depth += texel * R(s.constant);
      break;
    case ShadowBias::adaptive:  // a ten-thousandth of the depth range of the view, in addition to the plane
      set_plane(view, at.position_rws, at.shading_normal_ws, s.max_slope, p);
      p.depth += R((view.far - view.near) * 1e-4f * view.depth_per_unit) / (p.w * p.w);
      break;
    case ShadowBias::automatic:
      set_plane(view, at.position_rws, at.face_normal_ws, kSteepestSlope, p);
      p.depth += texel * automatic_depth_offset(s, tangent_of(clamp(abs(towards), R(0), R(1)), kSteepestSlope));
      break;
    default: break;
  }
  return p;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
