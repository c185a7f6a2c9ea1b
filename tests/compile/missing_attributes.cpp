// SPDX-License-Identifier: Apache-2.0
// A shader that lacks its Attributes struct must not compile, and the error must contain: struct Attributes.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Incomplete {
  template <class R>
  struct Varyings {
    vec3<R> color;
  };

  template <class R>
  vec4<R> vertex(const vec4<R>& in, Varyings<R>& out) const {
    out.color = vec3<R>(R(1));
    return in;
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color, R(1))};
  }
};

void draw_incomplete(Pass& pass, const VertexView& view) { pass.draw(Incomplete{}, view); }
