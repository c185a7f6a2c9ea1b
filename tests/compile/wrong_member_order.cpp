// SPDX-License-Identifier: Apache-2.0
// A shader whose Attributes have other members than the vertices, but as many floats, must not compile, and
// the error must contain: the streams do not match.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

struct UvFirstShader : ConstantShader {
  template <class R>
  struct Attributes {
    vec2<R> uv;
    vec3<R> position;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return vec4<R>(in.position, R(1));
  }
};
struct Vertex {
  glm::vec3 position;
  glm::vec2 uv;
};

void draw(Pass& pass, const std::vector<Vertex>& vertices) { pass.draw(UvFirstShader{}, make_vertex_view(stream(vertices))); }
