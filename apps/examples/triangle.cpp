// SPDX-License-Identifier: Apache-2.0
//
// Draws a triangle with colors interpolated between its vertices.
#include <cstdio>
#include <exception>

#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct ColorShader {
  // Vertex inputs, one member per vertex stream. R is float, or a SIMD vector that holds the values of several vertices.
  template <class R>
  struct Attributes {
    vec2<R> position;
    vec3<R> color;
  };
  // Outputs of the vertex function. They are interpolated over the triangle and passed to the fragment function.
  template <class R>
  struct Varyings {
    vec3<R> color;
  };

  // Vertex function. Returns the position in clip space.
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }

  // Fragment function. Returns a color in linear light.
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

int main(int argc, char** argv) try {
  const std::vector<glm::vec2> positions{{-0.8f, -0.8f}, {0.8f, -0.8f}, {0.0f, 0.8f}};
  const std::vector<glm::vec3> colors{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Image<glm::u8vec4> image(640, 480);
  ColorTarget target = srgb8a8_target(image);  // encodes linear colors as sRGB
  target.clear_value = {0.01f, 0.01f, 0.02f, 1.0f};

  Pass pass(640, 480, target, {});  // {}: no depth buffer
  pass.draw(ColorShader{}, make_vertex_view(stream(positions), stream(colors)));
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "triangle.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
