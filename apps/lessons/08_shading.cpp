// SPDX-License-Identifier: Apache-2.0
//
// Lesson 8: the same light on the same coarse sphere, with one normal per triangle (flat), with light per vertex (Gouraud) and with light
// per pixel (Phong).
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

enum class Rate { flat, gouraud, phong };

template <Rate rate>
struct LitShader {
  glm::mat4 clip_from_world;
  glm::vec3 offset, eye;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> position, normal, color;
  };

  // Phong's reflection model: ambient light, diffuse light, and a highlight around the reflection vector.
  template <class R>
  vec3<R> light(const vec3<R>& position, const vec3<R>& normal) const {
    const vec3<R> to_light(glm::normalize(glm::vec3(-1, 2, 2)));
    const vec3<R> to_eye = normalize(vec3<R>(eye) - position);
    const R diffuse = max(dot(normal, to_light), R(0));
    const vec3<R> reflected = normal * (R(2) * dot(normal, to_light)) - to_light;
    R highlight = max(dot(reflected, to_eye), R(0));
    for (int i = 0; i < 4; ++i) highlight = highlight * highlight;  // to the power of 16
    return vec3<R>(glm::vec3(0.8f, 0.3f, 0.2f)) * (R(0.1f) + R(0.8f) * diffuse) + vec3<R>(R(0.5f) * highlight);
  }

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position = in.position + vec3<R>(offset);
    out.normal = in.normal;
    out.color = light(out.position, out.normal);
    return clip_from_world * vec4<R>(out.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    if constexpr (rate == Rate::gouraud) return {vec4<R>(in.color, R(1))};
    vec3<R> normal = normalize(in.normal);  // interpolation shortens it
    if constexpr (rate == Rate::flat) normal = normalize(cross(px.ddx(&Varyings<R>::position), px.ddy(&Varyings<R>::position)));
    return {vec4<R>(light(in.position, normal), R(1))};
  }
};

int main(int argc, char** argv) try {
  const Mesh ball = uv_sphere(9, 14, 1.0f);
  const glm::vec3 eye(0, 0, 6);
  const glm::mat4 camera(perspective_reversed(0.6, 480.0 / 200.0, 0.1, 100.0) * look_at(glm::dvec3(eye), {0, 0, 0}, {0, 1, 0}));

  Image<glm::u8vec4> image(480, 200);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(480, 200, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  const auto vertices = make_vertex_view(stream(ball.positions), stream(ball.normals));
  pass.draw(LitShader<Rate::flat>{camera, {-2.4f, 0, 0}, eye}, vertices, ball.indices, kReversedZState);
  pass.draw(LitShader<Rate::gouraud>{camera, {0, 0, 0}, eye}, vertices, ball.indices, kReversedZState);
  pass.draw(LitShader<Rate::phong>{camera, {2.4f, 0, 0}, eye}, vertices, ball.indices, kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson08.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
