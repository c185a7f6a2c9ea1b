// SPDX-License-Identifier: Apache-2.0
//
// Lesson 6: the picture from lesson 3, drawn with the library. The camera is a matrix, the mesh is a list of vertices and indices, and the
// shader transforms the vertices and colors the pixels.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct FloorShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };

  // Runs once per vertex. R is a float or several floats; lesson 13 explains why.
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    const vec4<R> position = clip_from_world * vec4<R>(in.position, R(1));
    return position;
  }
  // Runs once per pixel, with perspective-correct varyings.
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const R tile = (floor(in.uv.x) + floor(in.uv.y)) * R(0.5f);
    const auto dark = tile != floor(tile);
    const vec3<R> yellow(glm::vec3(230, 180, 60) / 255.0f), blue(glm::vec3(40, 60, 120) / 255.0f);
    return {vec4<R>(select(dark, blue, yellow), R(1))};
  }
};

int main(int argc, char** argv) try {
  const std::vector<glm::vec3> positions{{-4, -1, -1.25}, {4, -1, -1.25}, {-4, -1, -9.25}, {4, -1, -9.25}};
  const std::vector<glm::vec2> uvs{{0, 0}, {8, 0}, {0, 8}, {8, 8}};
  const std::vector<uint32_t> indices{0, 3, 2, 0, 1, 3};

  const double fov = 1.0471975511965976;  // 60 degrees
  const glm::dvec3 eye(0, 0, 0), target(0, 0, -1), up(0, 1, 0);
  const glm::dmat4 camera = perspective_reversed(fov, 320.0 / 240.0, 0.1, 100.0) * look_at(eye, target, up);

  Image<glm::u8vec4> image(320, 240);
  ColorTarget color = rgba8_target(image);
  color.clear_value = glm::vec4(30, 30, 30, 255) / 255.0f;
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(FloorShader{glm::mat4(camera)}, make_vertex_view(stream(positions), stream(uvs)), indices, kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson06.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
