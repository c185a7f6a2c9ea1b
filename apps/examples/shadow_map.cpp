// SPDX-License-Identifier: Apache-2.0
//
// A hand-written shadow map: renders depth from the light, then compares it with the distance to the light at every pixel.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kSize = 512;  // of the shadow map
const glm::vec3 kToLight = glm::normalize(glm::vec3(3, 4, 2));

struct Shadowed {
  glm::mat4 clip_from_world, light_from_world;
  const Image<float>* shadow_map;  // null while the map is rendered
  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> normal = normalize(cross(px.ddx(&Varyings<R>::position), px.ddy(&Varyings<R>::position)));
    const vec4<R> p = light_from_world * vec4<R>(in.position, R(1));  // w is 1: the projection is orthographic
    const auto texel = [](const R& ndc) { return truncate_to_int(clamp((ndc + R(1)) * R(0.5f * kSize), R(0), R(kSize - 1.0f))); };
    const R nearest = gather(shadow_map->data(), texel(-p.y) * kSize + texel(p.x));  // images store the top row first
    const R lit = select(p.z + R(0.005f) >= nearest, max(dot(normal, vec3<R>(kToLight)), R(0)), R(0));
    return {vec4<R>(vec3<R>(glm::vec3(0.7f, 0.65f, 0.6f)) * (lit * R(0.8f) + R(0.2f)), R(1))};
  }
};

int main(int argc, char** argv) try {
  const std::vector<Mesh> meshes{cube(1.0f), plane(6.0f)};  // the ground plane cuts the cube in half
  const glm::mat4 light(orthographic_reversed(6.0, 1.0, 0.1, 12.0) * look_at({3, 4, 2}, {0, 0, 0}, {0, 1, 0}));
  const glm::mat4 camera(perspective_reversed(0.8, 640.0 / 480.0, 0.1, 100.0) * look_at({-2.5, 2.2, 3.5}, {0, 0, 0}, {0, 1, 0}));
  Image<float> map(kSize, kSize);
  Image<glm::u8vec4> image(640, 480);
  Pass from_light(kSize, kSize, {}, d32f_target(map, 0.0f));
  Pass pass(640, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const Mesh& m : meshes) {
    from_light.draw_depth(Shadowed{light, {}, nullptr}, make_vertex_view(stream(m.positions)), m.indices, kReversedZState);
    pass.draw(Shadowed{camera, light, &map}, make_vertex_view(stream(m.positions)), m.indices, kReversedZState);
  }
  from_light.run(Workers(Workers::cores()));  // first, because the other pass reads the map
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "shadow_map.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
