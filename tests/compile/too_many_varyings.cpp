// SPDX-License-Identifier: Apache-2.0
// A shader with more than 64 components of varyings must not compile, and the error must contain: more than 64 components.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

struct WideShader : PositionShader {
  template <class R>
  struct Varyings {
    std::array<vec4<R>, 16> many;
    R one;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.one = R(1);
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.one)};
  }
};

void draw(Pass& pass, const std::vector<glm::vec4>& positions) { pass.draw(WideShader{}, make_vertex_view(stream(positions))); }
