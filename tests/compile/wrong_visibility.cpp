// SPDX-License-Identifier: Apache-2.0
// A shader whose visibility function returns only a mask must not compile, and
// the error must contain: Visibility<R> visibility(const Varyings<R>& in.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct WrongVisibility {
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
  MaskOf<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    return px.x > R(3);
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(1)), px.x > R(3)};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw(WrongVisibility{}, view); }
