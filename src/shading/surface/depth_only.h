// SPDX-License-Identifier: Apache-2.0
//
// Draws only the depth of a mesh, for shadow maps.
#pragma once

#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

struct DepthOnly {
  glm::mat4 clip_from_object;

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
};

}  // namespace halfspace::HS_LANES
