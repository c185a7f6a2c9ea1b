// SPDX-License-Identifier: Apache-2.0
// A shader that lacks its fragment function must not compile, and the error must contain: fragment(const Varyings.
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
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = vec3<R>(R(1));
    return in.position;
  }
};

void draw_incomplete(Pass& pass, const VertexView& view) { pass.draw(Incomplete{}, view); }
