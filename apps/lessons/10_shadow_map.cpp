// SPDX-License-Identifier: Apache-2.0
//
// Lesson 10: a shadow map is a depth buffer drawn from the light. A point is in shadow if the map contains something nearer to the light.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kMapSize = 256;

struct ShadowShader {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 to_light;
  const Image<float>* map;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> position, normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.position, in.normal};
    return clip_from_world * vec4<R>(in.position, R(1));
  }

  // Returns 1 if the light reaches the point at (x, y, depth) in the map, otherwise 0. Depth is reversed: 1 is nearest to the light.
  template <class R>
  R lit(const R& x, const R& y, const R& depth) const {
    const R last(static_cast<float>(kMapSize - 1));
    const IntOf<R> column = truncate_to_int(clamp(x, R(0), last)), row = truncate_to_int(clamp(y, R(0), last));
    const R nearest = gather(map->data(), row * kMapSize + column);
    const R bias(0.012f);
    return select(depth + bias >= nearest, R(1), R(0));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const vec4<R> p = light_from_world * vec4<R>(in.position, R(1));
    const R x = (p.x + R(1)) * R(0.5f * kMapSize), y = (R(1) - p.y) * R(0.5f * kMapSize);  // texels; images store the top row first
    const R visible = lit(x, y, p.z);
    const R diffuse = max(dot(normalize(in.normal), vec3<R>(to_light)), R(0)) * visible;
    return {vec4<R>(vec3<R>(glm::vec3(0.75f, 0.7f, 0.6f)) * (R(0.12f) + R(0.88f) * diffuse), R(1))};
  }
};

int main(int argc, char** argv) try {
  Mesh meshes[]{torus_knot(0.7f, 0.16f, 24, 240), plane(6.0f)};
  for (glm::vec3& p : meshes[0].positions) p.y += 1.1f;  // above the plane
  const glm::dvec3 sun(3, 4, 2), center(0, 0.5, 0);
  const glm::vec3 to_light(glm::normalize(sun - center));
  const glm::dmat4 light = orthographic_reversed(6.0, 1.0, 0.1, 12.0) * look_at(sun, center, {0, 1, 0});
  const glm::dmat4 camera = perspective_reversed(0.7, 320.0 / 240.0, 0.1, 100.0) * look_at({-2, 3, 4.5}, {0, 0.6, 0}, {0, 1, 0});

  Image<float> map(kMapSize, kMapSize);
  Image<glm::u8vec4> image(320, 240);
  Pass from_light(kMapSize, kMapSize, {}, d32f_target(map, 0.0f));
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const Mesh& mesh : meshes) {
    const auto vertices = make_vertex_view(stream(mesh.positions), stream(mesh.normals));
    from_light.draw_depth(ShadowShader{glm::mat4(light), {}, {}, nullptr}, vertices, mesh.indices, kReversedZState);
    pass.draw(ShadowShader{glm::mat4(camera), glm::mat4(light), to_light, &map}, vertices, mesh.indices, kReversedZState);
  }
  from_light.run(Workers(1));
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson10.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
