// SPDX-License-Identifier: Apache-2.0
// A shader whose visibility function can drop fragments that its fragment function keeps must not compile, and
// the error must contain: fragment function neither discards nor returns a depth.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Disagreeing {
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
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    return {px.x > R(3), px.z()};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw(Disagreeing{}, view); }
