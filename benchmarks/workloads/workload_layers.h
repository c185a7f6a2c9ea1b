// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/texture/texture.h"
#include "workloads/workload_shading.h"

namespace halfspace {

/// Per-pixel Phong shading with per-vertex colors. The eye is at the origin.
struct LayerShader {
  glm::mat4 clip_from_eye;
  glm::vec3 light_es{0.5f, 0.5f, 0.0f};

  template <class R>
  struct Attributes {
    vec3<R> position_es, normal_es, base;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_es, normal_es, base;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_es = in.position_es;
    out.normal_es = in.normal_es;
    out.base = in.base;
    return clip_from_eye * vec4<R>(in.position_es, R(1));
  }
  /// HS_INLINE because g++ 12 does not inline a base class function of this size into the kernels.
  template <class R>
  HS_INLINE Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {lit(in.base, phong(unit(in.normal_es), unit(light_es - in.position_es), unit(-in.position_es)))};
  }
};

/// LayerShader with an alpha of 0.5.
struct BlendedLayerShader : LayerShader {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(vec3<R>(LayerShader::fragment(in, px).color), R(0.5f))};
  }
};

/// LayerShader that discards fragments where the red channel of a texture is below 0.5.
struct PerforatedLayerShader : LayerShader {
  const Texture2D* texture;

  template <class R>
  struct Varyings {
    vec3<R> position_es, normal_es, base;
    vec2<R> uv;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = vec2<R>(in.position_es) * 0.3f + vec2<R>(in.position_es.z * R(0.05f));
    LayerShader::Varyings<R> layer;
    const vec4<R> position_clip = LayerShader::vertex(in, layer);
    out.position_es = layer.position_es;
    out.normal_es = layer.normal_es;
    out.base = layer.base;
    return position_clip;
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {LayerShader::fragment(LayerShader::Varyings<R>{in.position_es, in.normal_es, in.base}, px).color, keeps(in, px)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {keeps(in, px), px.z()};
  }

 private:
  template <class R>
  HS_INLINE MaskOf<R> keeps(const Varyings<R>& in, const Pixel<R>& px) const {
    return texture->sample_rgb(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv)).x >= R(0.5f);
  }
};

}  // namespace halfspace
