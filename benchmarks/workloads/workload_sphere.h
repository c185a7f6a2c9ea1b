// SPDX-License-Identifier: Apache-2.0
//
// Shaders of the textured sphere, lit per pixel, per vertex, or per triangle (at its provoking vertex).
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/texture/texture.h"
#include "workloads/workload_shading.h"

namespace halfspace {

/// Base class of the sphere shaders.
struct SphereUniforms {
  glm::mat4 clip_from_world;
  const Texture2D* texture;
  glm::vec3 eye_ws{0.0f, 0.8f, 2.7f};
  glm::vec3 light_ws{2.0f, 3.0f, 4.0f};

  static constexpr Sampler kSampler{.wrap_t = Wrap::clamp};

  template <class R>
  struct Attributes {
    vec3<R> position_ws, normal_ws;
    vec2<R> uv;
  };

  template <class R>
  HS_INLINE WorkloadLight<R> light_at(const vec3<R>& p, const vec3<R>& n) const {
    return blinn_phong(n, unit(light_ws - p), unit(eye_ws - p));
  }
  template <class V, class R>
  HS_INLINE vec3<R> texel(const vec2<R>& uv, const Pixel<R>& px) const {
    return texture->sample_rgb(kSampler, uv, px.ddx(&V::uv), px.ddy(&V::uv));
  }
};

struct SpherePhong : SphereUniforms {
  template <class R>
  struct Varyings {
    vec3<R> position_ws, normal_ws;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_ws = in.position_ws;
    out.normal_ws = in.normal_ws;
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {lit(texel<Varyings<R>>(in.uv, px), light_at(in.position_ws, in.normal_ws))};
  }
};

/// SpherePhong, but eight times as bright.
struct SphereHdr : SpherePhong {
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(vec3<R>(SpherePhong::fragment(in, px).color) * 8.0f, R(1))};
  }
};

struct SphereGouraud : SphereUniforms {
  template <class R>
  struct Varyings {
    R diffuse, specular;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const WorkloadLight<R> light = light_at(in.position_ws, in.normal_ws);
    out.diffuse = light.diffuse;
    out.specular = light.specular;
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {lit(texel<Varyings<R>>(in.uv, px), WorkloadLight<R>{in.diffuse, in.specular})};
  }
};

struct SphereFlat : SphereUniforms {
  template <class R>
  struct Varyings {
    Flat<R> diffuse, specular;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const WorkloadLight<R> light = light_at(in.position_ws, in.normal_ws);
    out.diffuse.value = light.diffuse;
    out.specular.value = light.specular;
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {lit(texel<Varyings<R>>(in.uv, px), WorkloadLight<R>{in.diffuse.value, in.specular.value})};
  }
};

}  // namespace halfspace
