// SPDX-License-Identifier: Apache-2.0
//
// Lesson 15: a geometry function receives a whole triangle and emits any number of triangles: here the skin of a hedgehog and its quills.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

// Draws a sphere as an ellipsoid with quills.
struct QuillShader {
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::triangle_strip, .max_vertices = 7};
  glm::mat4 clip_from_world;
  glm::vec3 eye, center, radii, color;
  float hairline;  // quills grow where x - y / 2 is less

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal, color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {normalize(in.position / vec3<R>(radii)), vec3<R>(color)};
    return vec4<R>(in.position * vec3<R>(radii) + vec3<R>(center), R(1));  // in the world
  }

  // Runs once per triangle. Each lane of R is a triangle.
  template <class R>
  void geometry(const GeometryInput<R, Varyings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    const vec3<R> root = vec3<R>(in.position[0] + in.position[1] + in.position[2]) * R(1.0f / 3.0f);
    const vec3<R> normal = normalize(in.varyings[0].normal + in.varyings[1].normal + in.varyings[2].normal);
    const auto emit = [&](const vec3<R>& at, const glm::vec3& rgb, const MaskOf<R>& emits) {
      out.emit(clip_from_world * vec4<R>(at, R(1)), {normal, vec3<R>(rgb)}, emits);
    };
    const glm::vec3 dark(0.12f, 0.07f, 0.04f), light(0.85f, 0.7f, 0.5f);
    const vec3<R> along = normalize(normal + vec3<R>(glm::vec3(-0.8f, 0.1f, 0))) * R(0.5f);
    const vec3<R> across = normalize(cross(along, vec3<R>(eye) - root)) * R(0.05f);
    const MaskOf<R> grows = root.x - root.y * R(0.5f) < R(hairline);
    emit(root, dark, grows);
    emit(root + along * R(0.3f) - across, dark, grows);
    emit(root + along * R(0.3f) + across, dark, grows);
    emit(root + along, light, grows);
    out.end_primitive();
    for (std::size_t i = 0; i < 3; ++i) out.emit(clip_from_world * in.position[i], in.varyings[i]);  // the triangle itself
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const R diffuse = max(dot(normalize(in.normal), vec3<R>(glm::normalize(glm::vec3(1, 2, 2)))), R(0));
    return {vec4<R>(in.color * (R(0.2f) + R(0.8f) * diffuse), R(1))};
  }
};

int main(int argc, char** argv) try {
  const Mesh ball = icosphere(2, 1.0f);
  const glm::vec3 eye(3, 1.8f, 6), skin(0.7f, 0.5f, 0.35f), black(0.02f);
  const glm::mat4 camera(perspective_reversed(0.42, 320.0 / 220.0, 0.1, 100.0) * look_at(glm::dvec3(eye), {0, 0.85, 0}, {0, 1, 0}));
  // The body, the snout, the nose, two eyes and two feet. Only the body has quills.
  const QuillShader parts[]{{camera, eye, {0, 0.8f, 0}, {1, 0.75f, 0.75f}, skin, -0.1f},
                            {camera, eye, {0.85f, 0.68f, 0}, {0.55f, 0.36f, 0.36f}, skin, -9},
                            {camera, eye, {1.4f, 0.72f, 0}, {0.1f, 0.1f, 0.1f}, black, -9},
                            {camera, eye, {1.07f, 0.85f, 0.26f}, {0.07f, 0.07f, 0.07f}, black, -9},
                            {camera, eye, {1.07f, 0.85f, -0.26f}, {0.07f, 0.07f, 0.07f}, black, -9},
                            {camera, eye, {0.5f, 0.14f, 0.35f}, {0.24f, 0.14f, 0.15f}, skin, -9},
                            {camera, eye, {-0.25f, 0.12f, 0.35f}, {0.24f, 0.14f, 0.15f}, skin, -9}};

  Image<glm::u8vec4> image(320, 220);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.45f, 0.6f, 0.3f, 1};
  Pass pass(320, 220, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const QuillShader& part : parts) pass.draw(part, make_vertex_view(stream(ball.positions)), ball.indices, kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson15.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
