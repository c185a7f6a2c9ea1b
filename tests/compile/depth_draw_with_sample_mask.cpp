// SPDX-License-Identifier: Apache-2.0
// A shader whose fragment function returns a sample mask must not compile with draw_depth(), which does not call that function, and
// the error must contain: that of the shader returns a sample mask.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Masked {
  template <class R>
  struct Attributes {
    vec4<R> position;
  };
  template <class R>
  struct Varyings {};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
  template <class R>
  SampleMasked<R, Fragment<R>> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {{vec4<R>(R(1))}, IntOf<R>(1)};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw_depth(Masked{}, view); }
