// SPDX-License-Identifier: Apache-2.0
//
// A shader of your own in your own namespace: uniforms, three kinds of varyings, and discard.
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

namespace my {

using halfspace::abs, halfspace::floor, halfspace::select;  // for one number as for lanes of them
using halfspace::vec2, halfspace::vec3, halfspace::vec4;

struct RingShader {
  // Data members are uniforms: one value for the whole draw.
  float rings;
  glm::vec3 tint;

  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> smooth;                            // interpolated with perspective
    halfspace::NoPerspective<vec2<R>> window;  // interpolated linearly in the window
    halfspace::Flat<R> triangle;               // the provoking vertex's value over the whole triangle
  };

  // A vertex function may ask which vertex it makes.
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const halfspace::VertexId<R>& id, Varyings<R>& out) const {
    out.smooth = in.position;
    out.window.value = in.position;
    out.triangle.value = select(id.vertex < 3, R(0), R(1));
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }

  // Branches per pixel are select(); a fragment whose `keep` is false is discarded.
  template <class R>
  halfspace::DiscardingFragment<R> fragment(const Varyings<R>& in, const halfspace::Pixel<R>&) const {
    const R distance = length(in.smooth) * R(rings);
    const R ring = distance - floor(distance);
    const vec3<R> color = mix(vec3<R>(R(0.05f)), vec3<R>(tint), ring);
    return {vec4<R>(select(in.triangle.value > R(0.5f), color, color * R(0.5f)), R(1)), abs(in.window.value.x) < R(0.9f)};
  }
};

}  // namespace my

int main(int argc, char** argv) {
  using namespace halfspace;
  const std::vector<glm::vec2> quad{{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
  Image<glm::u8vec4> image(480, 480);
  Pass pass(480, 480, srgb8a8_target(image), {});
  pass.draw(my::RingShader{6.0f, {0.9f, 0.5f, 0.1f}}, make_vertex_view(stream(quad)));
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "own_shader.png", image);
}
