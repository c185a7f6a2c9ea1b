// SPDX-License-Identifier: Apache-2.0
// A shader whose fragment function returns a vec4 instead of a Fragment must not compile, and
// the error must contain: the shader's fragment function must return.
// For the type that it returns instead, the error must contain: VecN<4, float>.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct WrongFragment {
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
  vec4<R> fragment(const Varyings<R>&) const {
    return vec4<R>(R(1));
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw(WrongFragment{}, view); }
