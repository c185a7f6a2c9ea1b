// SPDX-License-Identifier: Apache-2.0
// A geometry function that emits lines must not compile with draw_naive(), and
// the error must contain: only geometry functions from triangles to triangle strips.
#include "halfspace/raster/naive.h"

using namespace halfspace;

struct TriangleToLines {
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::line_strip, .max_vertices = 2};
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
    for (std::size_t i = 0; i < 2; ++i) out.emit(in.position[i], in.varyings[i]);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(1))};
  }
};

void draw(NaiveTarget<float>& target, const VertexView& view, const Indices& indices) {
  draw_naive(target, TriangleToLines{}, view, indices);
}
