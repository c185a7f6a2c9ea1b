// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/contract.h"

namespace halfspace {

/// A mesh in one colour: its number, in red.
struct NumberedMesh {
  glm::mat4 clip_from_object;
  float number = 0.0f;

  template <class R>
  struct Attributes {
    vec3<R> position_os;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return clip_from_object * vec4<R>(in.position_os, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(number), R(0), R(0), R(1))};
  }
};

}  // namespace halfspace
