// SPDX-License-Identifier: Apache-2.0
// A shader that interpolates integers must not compile, and the error must contain: declare them as Flat<IntOf<R>>.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

struct SmoothIntegerShader : PositionShader {
  template <class R>
  struct Varyings {
    IntOf<R> number;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.number = IntOf<R>(1);
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(to_real<R>(in.number))};
  }
};

void draw(Pass& pass, const std::vector<glm::vec4>& positions) { pass.draw(SmoothIntegerShader{}, make_vertex_view(stream(positions))); }
