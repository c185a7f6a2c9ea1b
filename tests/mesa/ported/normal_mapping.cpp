// SPDX-License-Identifier: Apache-2.0
//
// A normal map in tangent space.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::normal_mapping {

// [normal_mapping]
struct NormalMapped {
  glm::mat4 clip_from_world;
  glm::vec3 light;
  Texture2DView normals;
  Sampler sampler;  // trilinear

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec4<R> tangent;  // w is the sign of the bitangent
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> world_position;
    mat3<R> frame;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec3<R> tangent(in.tangent);
    out.world_position = in.position;
    out.frame = mat3<R>(tangent, cross(in.normal, tangent) * in.tangent.w, in.normal);
    out.uv = in.uv * 2.0f;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> texel = normals.sample(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
    const vec3<R> n = normalize(in.frame * (vec3<R>(texel) * 2.0f - 1.0f));
    const R diffuse = max(dot(n, normalize(light - in.world_position)), R(0));
    return {vec4<R>(glm::vec3(0.7f, 0.6f, 0.5f) * (0.1f + diffuse), R(1))};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 texture_position;
uniform mat4 clip_from_world;
out vec3 world_position;
out mat3 frame;
out vec2 uv;

void main() {
  world_position = position;
  frame = mat3(tangent.xyz, cross(normal, tangent.xyz) * tangent.w, normal);
  uv = texture_position * 2.0;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 world_position;
in mat3 frame;
in vec2 uv;
uniform vec3 light;
uniform sampler2D normals;
out vec4 color;

void main() {
  vec3 n = normalize(frame * (texture(normals, uv).xyz * 2.0 - 1.0));
  float diffuse = max(dot(n, normalize(light - world_position)), 0.0);
  color = vec4(vec3(0.7, 0.6, 0.5) * (0.1 + diffuse), 1.0);
}
)glsl";

TEST_F(Ported, NormalMapping) {
  TwinTexture normals(TextureKind::two_d, TexelFormat::rgba8, {64, 64, 1}, 7);
  normals.fill([](int x, int y, int) {  // round studs, twice in each direction
    const glm::vec2 p = (glm::vec2(x % 32, y % 32) - 15.5f) / 16.0f;
    const float r = glm::length(p);
    const glm::vec3 n = r < 0.8f ? glm::normalize(glm::vec3(p * 0.9f, 1.0f)) : glm::vec3(0, 0, 1);
    return glm::vec4(n * 0.5f + 0.5f, 1.0f);
  });
  normals.generate_mipmaps();
  const Mesh mesh = cube(1.0f);
  const NormalMapped shader{camera({1.2, 1.0, 1.8}), {2.0f, 1.2f, 2.0f}, normals.view<TextureKind::two_d>(), {}};
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(shader, kVertex, kFragment,
             make_vertex_view(stream(mesh.positions), stream(mesh.normals), stream(mesh.tangents), stream(mesh.uvs)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", shader.clip_from_world);
               set("light", shader.light);
               set("normals", normals, shader.sampler);
             });
  stage.run();
  expect_same_picture(picture, {3, 0.001, "Mesa's level of detail uses an approximate log2, which is off by up to 0.04 levels"});
}

}  // namespace halfspace::test::ported::normal_mapping
