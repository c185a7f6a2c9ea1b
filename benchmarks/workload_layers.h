// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/contract.h"
#include "workload_shading.h"

namespace halfspace {

/// Phong by pixel, a colour a vertex; the eye is the origin.
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
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {lit(in.base, phong(unit(in.normal_es), unit(light_es - in.position_es), unit(-in.position_es)))};
  }
};

}  // namespace halfspace
