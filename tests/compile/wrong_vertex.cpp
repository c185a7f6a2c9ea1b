// SPDX-License-Identifier: Apache-2.0
// A shader whose vertex function does not return a clip-space vec4 must not compile, and the error must contain: vertex(const Attributes.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Incomplete {
  template <class R>
  struct Attributes {
    vec4<R> position;
  };

  template <class R>
  struct Varyings {
    vec3<R> color;
  };

  template <class R>
  vec3<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = vec3<R>(R(1));
    return vec3<R>(in.position);
  }

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.color, R(1))};
  }
};

void draw_incomplete(Pass& pass, const VertexView& view) { pass.draw(Incomplete{}, view); }
