// SPDX-License-Identifier: Apache-2.0
//
// The shader for points and lines of models: an unlit color per vertex.
#pragma once

#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

struct ColoredPrimitives {
  glm::mat4 clip_from_object;
  glm::vec4 color{1.0f};  ///< linear; multiplies the vertex colors

  template <class R>
  struct Attributes {
    vec3<R> position_os;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec4<R> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color * vec4<R>(color);
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

}  // namespace halfspace::HS_LANES
