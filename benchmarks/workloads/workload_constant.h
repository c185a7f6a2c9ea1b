// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/contract.h"

namespace halfspace {

/// Draws in one color. Vertex positions are in normalized device coordinates.
struct ConstantShader {
  glm::vec4 color;

  template <class R>
  struct Attributes {
    vec3<R> position_ndc;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return vec4<R>(in.position_ndc, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(color.x), R(color.y), R(color.z), R(color.w))};
  }
};

}  // namespace halfspace
