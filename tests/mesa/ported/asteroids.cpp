// SPDX-License-Identifier: Apache-2.0
//
// Instanced asteroids, whose colors are bytes.
#include <random>

#include "mesa/ported/scene.h"

namespace halfspace::test::ported::asteroids {

// [asteroids]
struct Asteroids {
  glm::mat4 clip_from_world;
  float time;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec4<R> orbit;  // per instance: radius, angle, height, size
    vec4<R> color;  // per instance: four bytes, normalized
  };
  template <class R>
  struct Varyings {
    vec3<R> normal;
    Flat<vec3<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const R angle = in.orbit.y + time / in.orbit.x;
    const R c = cos(angle), s = sin(angle);
    const auto turned = [&](const vec3<R>& v) { return vec3<R>(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
    out.normal = turned(in.normal);
    out.color.value = vec3<R>(in.color);
    return clip_from_world * vec4<R>(turned(in.position * in.orbit.w + vec3<R>(in.orbit.x, in.orbit.z, R(0))), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const R diffuse = max(dot(normalize(in.normal), glm::vec3(0.6f, 0.8f, 0.0f)), R(0));
    return {vec4<R>(in.color.value * (0.2f + 0.8f * diffuse), R(1))};
  }
};
// [end]

// [asteroids_streams]
struct Rock {
  glm::vec4 orbit;
  glm::u8vec4 color;
};
auto rock_streams(const Mesh& mesh, const std::vector<Rock>& rocks) {
  return make_vertex_view(stream(mesh.positions), stream(mesh.normals), per_instance(stream(rocks, &Rock::orbit)),
                          per_instance(stream<ReadAs::normalized>(rocks, &Rock::color)));
}
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 orbit;  // glVertexAttribDivisor(2, 1)
layout(location = 3) in vec4 color;  // GL_UNSIGNED_BYTE, normalized
uniform mat4 clip_from_world;
uniform float time;
out vec3 world_normal;
flat out vec3 rock_color;

void main() {
  float angle = orbit.y + time / orbit.x;
  float c = cos(angle), s = sin(angle);
  mat3 turn = mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
  world_normal = turn * normal;
  rock_color = color.rgb;
  gl_Position = clip_from_world * vec4(turn * (position * orbit.w + vec3(orbit.x, orbit.z, 0.0)), 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 world_normal;
flat in vec3 rock_color;
out vec4 color;

void main() {
  float diffuse = max(dot(normalize(world_normal), vec3(0.6, 0.8, 0.0)), 0.0);
  color = vec4(rock_color * (0.2 + 0.8 * diffuse), 1.0);
}
)glsl";

TEST_F(Ported, InstancedAsteroidsWithByteColors) {
  const Mesh mesh = icosphere(1, 1.0f);
  std::mt19937 random(1);
  const auto number = [&](float low, float high) { return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f; };
  std::vector<Rock> rocks;
  for (int i = 0; i < 200; ++i) {
    const auto code = [&] { return static_cast<uint8_t>(random() >> 24); };
    rocks.push_back({{number(1, 3), number(0, 6.2f), number(-0.4f, 0.4f), number(0.06f, 0.2f)}, {code(), code(), code(), 255}});
  }
  const Asteroids shader{camera({0, 3, 6}), 2.0f};
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  DrawState state;
  state.instances = static_cast<uint32_t>(rocks.size());
  state.cull = CullMode::back;
  stage.draw(
      shader, kVertex, kFragment, rock_streams(mesh, rocks), mesh.indices,
      [&](const UniformSetter& set) {
        set("clip_from_world", shader.clip_from_world);
        set("time", shader.time);
      },
      state);
  stage.run();
  expect_same_picture(picture,
                      {1, 0.002, "positions depend on sin and cos, whose last bits differ, so a few pixels at edges change sides"});
}

}  // namespace halfspace::test::ported::asteroids
