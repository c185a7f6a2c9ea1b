// SPDX-License-Identifier: Apache-2.0
//
// A sphere that reflects and refracts a cube map.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::cube_map {

// [cube_map]
struct Glass {
  glm::mat4 clip_from_world;
  glm::vec3 eye;
  TextureCubeView environment;
  Sampler sampler;  // trilinear

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
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    // The directions are computed, so their derivatives are differences between pixels of the quad.
    const auto reflected = [&](const Varyings<R>& v) { return reflect(v.world_position - eye, normalize(v.world_normal)); };
    const auto refracted = [&](const Varyings<R>& v) {
      return refract(normalize(v.world_position - eye), normalize(v.world_normal), R(1.0f / 1.5f));
    };
    const auto lookup = [&](const auto& direction) {
      return environment.sample(sampler, direction(in), px.template quad_ddx<Varyings<R>>(direction),
                                px.template quad_ddy<Varyings<R>>(direction));
    };
    const R cosine = max(dot(normalize(eye - in.world_position), normalize(in.world_normal)), R(0));
    const R fresnel = 0.04f + 0.96f * pow(1.0f - cosine, R(5));
    return {mix(lookup(refracted), lookup(reflected), fresnel)};
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
uniform vec3 eye;
uniform samplerCube environment;
out vec4 color;

void main() {
  vec3 n = normalize(world_normal);
  vec3 reflected = reflect(world_position - eye, n);
  vec3 refracted = refract(normalize(world_position - eye), n, 1.0 / 1.5);
  float cosine = max(dot(normalize(eye - world_position), n), 0.0);
  float fresnel = 0.04 + 0.96 * pow(1.0 - cosine, 5.0);
  color = mix(texture(environment, refracted), texture(environment, reflected), fresnel);
}
)glsl";

TEST_F(Ported, CubeMapReflectionAndRefraction) {
  TwinTexture environment(TextureKind::cube, TexelFormat::rgba8, {64, 64, 6}, 7);
  environment.fill([](int x, int y, int face) {
    const float tint = static_cast<float>(face) / 5.0f, checker = (x / 8 + y / 8) % 2 == 0 ? 0.25f : 0.0f;
    return glm::vec4(tint + checker * 0.5f, static_cast<float>(x) / 80.0f + checker, static_cast<float>(y) / 80.0f, 1.0f);
  });
  environment.generate_mipmaps();
  const Mesh mesh = icosphere(4, 1.0f);
  const glm::vec3 eye(0.8f, 0.7f, 2.4f);
  const Glass shader{camera(eye), eye, environment.view<TextureKind::cube>(), {}};
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(shader, kVertex, kFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", shader.clip_from_world);
               set("eye", shader.eye);
               set("environment", environment, shader.sampler);
             });
  stage.run();
  // The pixels beyond 4 codes are at the silhouette. Without levels, there are none, and none differs by more than 2 codes.
  expect_same_picture(
      picture,
      {4, 0.002, "at the silhouette, differences within the quad read values outside of thin triangles, so levels of detail differ"});
}

}  // namespace halfspace::test::ported::cube_map
