// SPDX-License-Identifier: Apache-2.0
//
// A shadow map that a sampler2DShadow reads.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::shadow {

// [shadow_depth]
struct LightDepth {
  glm::mat4 light_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return light_from_world * vec4<R>(in.position, R(1));
  }
};
// [end]

constexpr const char* kDepthVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 light_from_world;

void main() { gl_Position = light_from_world * vec4(position, 1.0); }
)glsl";

constexpr const char* kDepthFragment = R"glsl(#version 330 core
void main() {}
)glsl";

// [shadow]
struct Shadowed {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 to_light;
  Texture2DView shadow_map;
  Sampler sampler;  // bilinear, CompareOp::less_equal

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> world_normal;
    vec4<R> light_position;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.world_normal = in.normal;
    out.light_position = light_from_world * vec4<R>(in.position, R(1));
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> p = vec3<R>(in.light_position) / in.light_position.w * 0.5f + 0.5f;
    // The map has one level, so the lookup needs no derivatives.
    const R lit = shadow_map.sample_compare_level(sampler, vec2<R>(p), p.z - 0.004f, R(0));
    const R diffuse = max(dot(normalize(in.world_normal), to_light), R(0));
    return {vec4<R>(vec3<R>(0.15f + 0.8f * lit * diffuse), R(1))};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world, light_from_world;
out vec3 world_normal;
out vec4 light_position;

void main() {
  world_normal = normal;
  light_position = light_from_world * vec4(position, 1.0);
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 world_normal;
in vec4 light_position;
uniform vec3 to_light;
uniform sampler2DShadow shadow_map;
out vec4 color;

void main() {
  vec3 p = light_position.xyz / light_position.w * 0.5 + 0.5;
  float lit = texture(shadow_map, vec3(p.xy, p.z - 0.004));
  float diffuse = max(dot(normalize(world_normal), to_light), 0.0);
  color = vec4(vec3(0.15 + 0.8 * lit * diffuse), 1.0);
}
)glsl";

TEST_F(Ported, ShadowWithSampler2DShadow) {
  const Mesh mesh = still_life();
  const glm::mat4 light(orthographic_gl(4.0, 1.0, 0.5, 9.0) * look_at({3, 4, 2}, {0, 0, 0}, {0, 1, 0}));
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f), map(TexelFormat::d32f);
  TwinStage from_light({}, TwinTarget{map, glm::vec4(1)});
  from_light.draw(LightDepth{light}, kDepthVertex, kDepthFragment, make_vertex_view(stream(mesh.positions)), mesh.indices,
                  [&](const UniformSetter& set) { set("light_from_world", light); });
  from_light.run();

  const Shadowed shader{camera({-1.5, 2.5, 3.0}),
                        light,
                        glm::normalize(glm::vec3(3, 4, 2)),
                        map.view<TextureKind::two_d>(),
                        {.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp}};
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(shader, kVertex, kFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", shader.clip_from_world);
               set("light_from_world", shader.light_from_world);
               set("to_light", shader.to_light);
               set("shadow_map", map, shader.sampler, true);
             });
  stage.run();
  expect_same_picture(picture, {1, 0.002, "edges move by up to 1/256 px, and a comparison flips where depths are equal up to rounding"});
}

}  // namespace halfspace::test::ported::shadow
