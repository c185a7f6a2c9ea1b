// SPDX-License-Identifier: Apache-2.0
//
// Shadows of a point light. One pass draws the distances to the light into all six faces of a cube map, with an instance per face.
#include <cstdio>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;
constexpr glm::vec3 kLight(1.5f, 2.0f, 1.5f);
struct PointLight {
  std::array<glm::mat4, 6> clip_from_world;  // of each instance
  const TextureCubeView* distances;          // null while the cube map is rendered
  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  LayeredVertex<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out = in;
    return {clip_from_world[static_cast<std::size_t>(id.instance)] * vec4<R>(in.position, R(1)), IntOf<R>(id.instance)};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const R far = length(in.position - kLight), depth = far * R(1.0f / 8.0f);
    const R lit = distances ? distances->sample_compare_level(Sampler{}, in.position - kLight, depth - R(0.01f), R(0)) : R(0);
    return {vec4<R>(vec3<R>(lit * R(2) / (far * far) + R(0.02f)), R(1)), MaskOf<R>(true), distances ? px.z() : depth};
  }
};

int main(int argc, char** argv) try {
  PointLight shader{};
  for (std::size_t i = 0; i < 6; ++i) {  // the faces, with the directions up of OpenGL 4.6, table 8.19
    const glm::dvec3 eye(kLight), axis(i / 2 == 0, i / 2 == 1, i / 2 == 2), ahead = i % 2 == 0 ? axis : -axis;
    const glm::dmat4 view = look_at(eye, eye + ahead, i / 2 == 1 ? glm::dvec3(0, 0, ahead.y) : glm::dvec3(0, -1, 0));
    shader.clip_from_world[i] = perspective_reversed(1.5707963267948966, 1.0, 0.05, 50.0) * view;
  }
  const glm::mat4 camera(perspective_reversed(0.8, 1.0, 0.1, 100.0) * look_at({-4, 4, 5}, {0, 0, 0}, {0, 1, 0}));
  TextureMemory map(TextureKind::cube, TexelFormat::d32f, {512, 512, 6});
  const auto view = map.view<TextureKind::cube>();
  Image<glm::u8vec4> image(480, 480);
  Pass faces(512, 512, {}, layered_depth_target(map.level()), {.layers = 6});
  Pass pass(480, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  const std::vector<Mesh> meshes{plane(7.0f), cube(1.2f)};
  for (const Mesh& m : meshes) {
    faces.draw(shader, make_vertex_view(stream(m.positions)), m.indices, {.instances = 6, .depth = {.clip = ClipDepth::zero_to_one}});
    pass.draw(PointLight{{camera}, &view}, make_vertex_view(stream(m.positions)), m.indices, kReversedZState);
  }
  for (Pass* const each : {&faces, &pass}) each->run(Workers(Workers::cores()));  // the second pass reads the cube map
  write_image(argc > 1 ? argv[1] : "shadow_cube.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
