// SPDX-License-Identifier: Apache-2.0
//
// Draws a line along the normal at each corner of each triangle, with a geometry function.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct NormalLines {
  glm::mat4 clip_from_world;
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::line_strip, .max_vertices = 6};

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.normal;
    return vec4<R>(in.position, R(1));  // in the world; the geometry function transforms it
  }
  // Receives the three vertices of a triangle. Each lane of R is a triangle.
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const vec3<R> normal = in.varyings[i].color;
      const Varyings<R> color{normal * R(0.5f) + vec3<R>(R(0.5f))};
      out.emit(clip_from_world * in.position[i], color);
      out.emit(clip_from_world * (in.position[i] + vec4<R>(normal * R(0.3f), R(0))), color);
      out.end_primitive();
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

int main(int argc, char** argv) try {
  const Mesh ball = icosphere(2, 1.0f);
  const glm::dmat4 camera = perspective_reversed(0.8, 1.0, 0.1, 100.0) * look_at({0, 1, 3.4}, {0, 0, 0}, {0, 1, 0});
  Image<glm::u8vec4> image(480, 480);
  Pass pass(480, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(NormalLines{glm::mat4(camera)}, make_vertex_view(stream(ball.positions), stream(ball.normals)), ball.indices, kReversedZState);
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "normals.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
