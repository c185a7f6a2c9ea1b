// SPDX-License-Identifier: Apache-2.0
//
// Defines a shader in a user namespace, with uniforms, three kinds of varyings, and discard.
#include <cstdio>
#include <exception>

#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

namespace my {

// The functions work for scalars and for SIMD lanes.
using halfspace::abs, halfspace::floor, halfspace::select, halfspace::vec2, halfspace::vec3, halfspace::vec4;

struct RingShader {
  float rings;  // data members are uniforms: they have one value for the whole draw call
  glm::vec3 tint;

  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> smooth;                            // interpolated with perspective correction
    halfspace::NoPerspective<vec2<R>> window;  // interpolated linearly in window space
    halfspace::Flat<R> triangle;               // not interpolated; has the value of the provoking vertex
  };
  // The VertexId parameter is optional. It holds the index of the vertex being shaded.
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const halfspace::VertexId<R>& id, Varyings<R>& out) const {
    out.smooth = in.position;
    out.window.value = in.position;
    out.triangle.value = select(id.vertex < 3, R(0), R(1));
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }
  // Use select() to branch per pixel. The second member of the result is the mask of the fragments to keep; the others are discarded.
  template <class R>
  halfspace::DiscardingFragment<R> fragment(const Varyings<R>& in, const halfspace::Pixel<R>&) const {
    const R distance = length(in.smooth) * R(rings), ring = distance - floor(distance);
    const vec3<R> color = mix(vec3<R>(R(0.05f)), vec3<R>(tint), ring);
    return {vec4<R>(select(in.triangle.value > R(0.5f), color, color * R(0.5f)), R(1)), abs(in.window.value.x) < R(0.9f)};
  }
};

}  // namespace my

int main(int argc, char** argv) try {
  using namespace halfspace;
  const std::vector<glm::vec2> quad{{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
  Image<glm::u8vec4> image(480, 480);
  Pass pass(480, 480, srgb8a8_target(image), {});
  pass.draw(my::RingShader{6.0f, {0.9f, 0.5f, 0.1f}}, make_vertex_view(stream(quad)));
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "own_shader.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
