// SPDX-License-Identifier: Apache-2.0
// A shader that discards in its fragment function only must not compile with draw_depth(), which does not call that function, and
// the error must contain: Visibility<R> visibility(const Varyings<R>& in.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Cutout {
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
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(R(1)), px.x > R(3)};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw_depth(Cutout{}, view); }
