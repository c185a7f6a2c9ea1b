// SPDX-License-Identifier: Apache-2.0
//
// A triangle whose colours are interpolated between its corners.
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct ColorShader {
  // One member per vertex stream. R is a number, or as many numbers as the processor has SIMD lanes.
  template <class R>
  struct Attributes {
    vec2<R> position;
    vec3<R> color;
  };
  // What the vertex function hands to the fragment function, interpolated on the way.
  template <class R>
  struct Varyings {
    vec3<R> color;
  };

  // Returns the position in clip space.
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }

  // Returns a linear colour.
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

int main(int argc, char** argv) {
  const std::vector<glm::vec2> positions{{-0.8f, -0.8f}, {0.8f, -0.8f}, {0.0f, 0.8f}};
  const std::vector<glm::vec3> colors{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Image<glm::u8vec4> image(640, 480);
  ColorTarget target = srgb8a8_target(image);  // encodes linear colours to sRGB
  target.clear_value = {0.01f, 0.01f, 0.02f, 1.0f};

  Pass pass(640, 480, target, {});  // {}: no depth buffer
  pass.draw(ColorShader{}, make_vertex_view(stream(positions), stream(colors)));
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "triangle.png", image);
}
