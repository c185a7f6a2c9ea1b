// SPDX-License-Identifier: Apache-2.0
// A shader whose geometry function receives other primitives than its layout states must not compile, and
// the error must contain: N is the number of vertices of geometry_layout.input.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct WrongGeometry {
  static constexpr GeometryLayout geometry_layout{.input = GeometryInputPrimitive::lines};
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
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    out.emit(in.position[0], in.varyings[0]);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

void draw(Pass& pass, const VertexView& view) { pass.draw(WrongGeometry{}, view); }
