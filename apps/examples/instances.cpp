// SPDX-License-Identifier: Apache-2.0
//
// Draws 10,000 instances of a mesh with one draw call.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct InstanceShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position;  // per vertex
    vec3<R> normal;    // per vertex
    vec3<R> offset;    // per instance
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const R light = max(dot(in.normal, vec3<R>(glm::vec3(0.36f, 0.8f, 0.48f))), R(0)) + R(0.1f);
    out.color = (in.offset * R(0.01f) + vec3<R>(R(0.5f))) * light;
    return clip_from_world * vec4<R>(in.position + in.offset, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

int main(int argc, char** argv) try {
  const Mesh ball = icosphere(1, 0.4f);
  std::vector<glm::vec3> offsets;
  for (int i = 0; i < 10000; ++i) {
    const float x = static_cast<float>(i % 100) - 49.5f, z = static_cast<float>(i / 100) - 49.5f;
    offsets.emplace_back(x, 0.004f * (x * x - z * z), z);
  }
  const glm::dmat4 camera = perspective_reversed(0.8, 640.0 / 480.0, 1.0, 1000.0) * look_at({0, 60, 90}, {0, 0, 0}, {0, 1, 0});

  Image<glm::u8vec4> image(640, 480);
  Pass pass(640, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  DrawState state = kReversedZState;
  state.instances = static_cast<uint32_t>(offsets.size());
  pass.draw(InstanceShader{glm::mat4(camera)},
            make_vertex_view(stream(ball.positions), stream(ball.normals), per_instance(stream(offsets))), ball.indices, state);
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "instances.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
