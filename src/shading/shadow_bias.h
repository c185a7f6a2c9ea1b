// SPDX-License-Identifier: Apache-2.0
//
// Keeps a surface out of its own shadow. A map knows one depth per texel, the surface's depth changes over it: by the
// texel's width times the tangent of the light's angle. Every method either lifts the point by about so much, or asks for
// the surface's depth where the map took its own.
#pragma once

#include <algorithm>

#include "shading/shadow_view.h"

namespace halfspace {

/// How far from the point, in texels, the filter looks: a bias has to hold over that distance.
inline float filter_reach(const ShadowSettings& s) {
  switch (s.filter) {
    case ShadowFilter::hard: return 0.5f;
    case ShadowFilter::bilinear: return 1.0f;
    case ShadowFilter::pcf3: return 2.0f;
    case ShadowFilter::pcf5: return 3.0f;
    case ShadowFilter::pcf7: return 4.0f;
    case ShadowFilter::pcss: return std::max(s.radius, kMaxPenumbra) + 0.5f;
    default: return s.radius + 0.5f;
  }
}

/// Where the receiver lies on the view, moved by the bias that the settings ask for.
template <class R>
HS_INLINE ShadowPlace<R> biased_place(const ShadowView& view, const ShadowSettings& s, const ShadowReceiver<R>& at) {
  const float reach = filter_reach(s);
  const R cosine = clamp(dot(at.face_normal_ws, at.to_light_ws), R(0), R(1));
  const R sine = sqrt(R(1) - cosine * cosine);
  const R tangent = min(sine / max(cosine, R(1e-6f)), R(s.max_slope));

  if (s.bias == ShadowBias::normal_offset || s.bias == ShadowBias::automatic) {
    // A step h along the normal lifts a point over its plane by h/cos against the light; the texel needs reach·tan.
    const ShadowPlace<R> there = place_on(view, at.position_ew);
    const float texels = s.bias == ShadowBias::automatic ? kAutomaticOffset : s.constant * reach;
    const R step = R(texels * view.texel_per_w) * there.w * sine;
    const vec3<R> lifted_ew = at.position_ew + at.face_normal_ws * step;
    ShadowPlace<R> p = place_on(view, lifted_ew);
    if (s.bias == ShadowBias::automatic) {
      set_plane(view, lifted_ew, at.face_normal_ws, s.max_slope, p);
      p.depth += depth_of_texel(view, p.w) * R(kAutomaticConstant);
    }
    return p;
  }

  ShadowPlace<R> p = place_on(view, at.position_ew);
  const R texel = depth_of_texel(view, p.w);
  switch (s.bias) {
    case ShadowBias::constant: p.depth += texel * R(s.constant); break;
    case ShadowBias::slope: p.depth += texel * (R(s.slope * reach) * tangent + R(s.constant)); break;
    case ShadowBias::angle: p.depth += texel * max(R(s.slope) * (R(1) - cosine), R(s.constant)); break;
    case ShadowBias::original: p.depth += R(0.0005f); break;
    case ShadowBias::receiver_plane:
      set_plane(view, at.position_ew, at.face_normal_ws, s.max_slope, p);
      p.depth += texel * R(s.constant);
      break;
    case ShadowBias::adaptive:
      set_plane(view, at.position_ew, at.shading_normal_ws, s.max_slope, p);
      p.depth += R((view.far - view.near) * 1e-4f * view.depth_per_unit) / (p.w * p.w);
      break;
    default: break;
  }
  return p;
}

}  // namespace halfspace
