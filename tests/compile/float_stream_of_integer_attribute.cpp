// SPDX-License-Identifier: Apache-2.0
// A shader with an integer attribute must not compile with a stream of floats, and the error must contain: the streams do not match.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

struct JointShader : ConstantShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    IntOf<R> joint;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position + vec4<R>(to_real<R>(in.joint));
  }
};

void draw(Pass& pass, const std::vector<glm::vec4>& positions, const std::vector<uint8_t>& joints) {
  pass.draw(JointShader{}, make_vertex_view(stream(positions), stream<ReadAs::floats>(joints)));
}
