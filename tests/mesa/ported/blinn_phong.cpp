// SPDX-License-Identifier: Apache-2.0
//
// Blinn-Phong lighting with one point light.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::blinn_phong {

// [blinn_phong]
struct BlinnPhong {
  glm::mat4 clip_from_world;
  glm::vec3 eye, light, diffuse;
  float shininess;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> world_position, world_normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.world_position = in.position;
    out.world_normal = in.normal;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> n = normalize(in.world_normal);
    const vec3<R> l = normalize(light - in.world_position);
    const vec3<R> v = normalize(eye - in.world_position);
    const vec3<R> h = normalize(l + v);
    const R specular = pow(max(dot(n, h), R(0)), R(shininess));
    const vec3<R> color = diffuse * (0.1f + max(dot(n, l), R(0))) + 0.5f * specular;
    return {vec4<R>(color, R(1))};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 world_position;
out vec3 world_normal;

void main() {
  world_position = position;
  world_normal = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 world_position;
in vec3 world_normal;
uniform vec3 eye, light, diffuse;
uniform float shininess;
out vec4 color;

void main() {
  vec3 n = normalize(world_normal);
  vec3 l = normalize(light - world_position);
  vec3 v = normalize(eye - world_position);
  vec3 h = normalize(l + v);
  float specular = pow(max(dot(n, h), 0.0), shininess);
  color = vec4(diffuse * (0.1 + max(dot(n, l), 0.0)) + 0.5 * specular, 1.0);
}
)glsl";

TEST_F(Ported, BlinnPhong) {
  const Mesh mesh = still_life();
  const glm::vec3 eye(1.5f, 2.0f, 3.0f);
  const BlinnPhong shader{camera(eye, {0, 0.3, 0}), eye, {2, 3, 1}, {0.6f, 0.3f, 0.2f}, 32.0f};
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(shader, kVertex, kFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", shader.clip_from_world);
               set("eye", shader.eye);
               set("light", shader.light);
               set("diffuse", shader.diffuse);
               set("shininess", shader.shininess);
             });
  stage.run();
  expect_same_picture(picture, {1, 0.001, "Mesa does not snap vertices before interpolation, which moves some edges by up to 1/256 px"});
}

}  // namespace halfspace::test::ported::blinn_phong
