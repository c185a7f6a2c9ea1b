// SPDX-License-Identifier: Apache-2.0
//
// Draws the depth of a surface that is not opaque, for shadow maps.
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/surface/metallic_surface.h"
#include "halfspace/shading/values/tone.h"

namespace halfspace::HS_LANES {

/// How opacity decides whether a texel of a shadow map is covered.
struct OpacityTest {
  std::array<MaterialMap, 2> maps;  ///< factors of the opacity: weighted sums of channels; both maps use the same texture coordinates
  float opacity = 1.0f;
  float cutoff = 0.5f;    ///< covered where opacity ≥ cutoff
  bool dithered = false;  ///< ignores the cutoff: covers texels in an ordered pattern, in proportion to the opacity
  friend bool operator==(const OpacityTest&, const OpacityTest&) = default;
};

/// colored: vertices have colors, whose alpha multiplies the opacity.
template <bool colored>
struct MaskedDepth {
  glm::mat4 clip_from_object;
  OpacityTest test;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec2<R> uv;
    [[no_unique_address]] MemberIf<colored, vec4<R>, 0> color;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
    [[no_unique_address]] MemberIf<colored, R, 0> opacity;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    if constexpr (colored) out.opacity = in.color.w;
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(R(0)), visibility(in, px).keep};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    using V = Varyings<R>;
    R opacity(test.opacity);
    if constexpr (colored) opacity *= in.opacity;
    for (const MaterialMap& map : test.maps) {
      if (map.map == nullptr) continue;
      const MapCoordinates<R> at = transformed(map.uv_transform, MapCoordinates<R>{in.uv, px.ddx(&V::uv), px.ddy(&V::uv)});
      opacity *= map.channel == glm::vec4(0, 0, 0, 1)
                     ? map.map->sample_alpha(map.sampler, at.uv, at.duv_dx, at.duv_dy)
                     : dot(map.map->sample(map.sampler, at.uv, at.duv_dx, at.duv_dy), vec4<R>(map.channel));
    }
    if (!test.dithered) return {opacity >= R(test.cutoff), {}};
    // The pattern is not visible in the image, because the shadow filter averages it.
    return {opacity > dither_threshold<R>(truncate_to_int(px.x), truncate_to_int(px.y)), {}};
  }
};

}  // namespace halfspace::HS_LANES
