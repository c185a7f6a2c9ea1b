// SPDX-License-Identifier: Apache-2.0
// A shader that lacks its Varyings struct must not compile, and the error must contain: struct Varyings.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Incomplete {
  template <class R>
  struct Attributes {
    vec4<R> position;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in) const {
    return in.position;
  }
};

void draw_incomplete(Pass& pass, const VertexView& view) { pass.draw(Incomplete{}, view); }
