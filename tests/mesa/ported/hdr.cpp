// SPDX-License-Identifier: Apache-2.0
//
// High dynamic range: a pass that draws light into halves, and one that maps it to the range of a screen.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::hdr {

// [hdr_scene]
struct BrightScene {
  glm::mat4 clip_from_world;
  std::array<glm::vec3, 3> lights, colors;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    vec3<R> sum(R(0.02f));
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const vec3<R> d = lights[i] - in.position;
      sum += colors[i] * (max(dot(normalize(in.normal), normalize(d)), R(0)) / dot(d, d));
    }
    return {vec4<R>(sum, R(1))};
  }
};
// [end]
constexpr const char* kSceneVertex = R"glsl(#version 330 core
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
constexpr const char* kSceneFragment = R"glsl(#version 330 core
in vec3 world_position;
in vec3 world_normal;
uniform vec3 lights[3], colors[3];
out vec4 color;

void main() {
  vec3 sum = vec3(0.02);
  for (int i = 0; i < 3; ++i) {
    vec3 d = lights[i] - world_position;
    sum += colors[i] * (max(dot(normalize(world_normal), normalize(d)), 0.0) / dot(d, d));
  }
  color = vec4(sum, 1.0);
}
)glsl";

// [hdr]
struct ToneMap : FullScreen {
  Texture2DView light;
  Sampler sampler;
  float exposure;

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> color(light.sample_level(sampler, in.uv, R(0)));
    const vec3<R> mapped = 1.0f - exp(-color * exposure);
    return {vec4<R>(pow(mapped, vec3<R>(R(1.0f / 2.2f))), R(1))};
  }
};
// [end]
constexpr const char* kToneFragment = R"glsl(#version 330 core
in vec2 uv;
uniform sampler2D light;
uniform float exposure;
out vec4 color;

void main() {
  vec3 mapped = vec3(1.0) - exp(-texture(light, uv).rgb * exposure);
  color = vec4(pow(mapped, vec3(1.0 / 2.2)), 1.0);
}
)glsl";

TEST_F(Ported, HighDynamicRange) {
  constexpr Sampler sampler{.mag = Filter::nearest, .min = Filter::nearest, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  const Mesh mesh = still_life();
  const BrightScene scene{camera({1.5, 2.0, 3.0}, {0, 0.3, 0}),
                          {glm::vec3(0, 0.3f, 1), glm::vec3(-1.5f, 1.5f, 0.5f), glm::vec3(1.4f, 1, -1)},
                          {glm::vec3(6, 4, 2), glm::vec3(0.5f, 0.5f, 1), glm::vec3(0, 1, 0.3f)}};
  Flat2D light(TexelFormat::rgba16f), depth(TexelFormat::d32f), picture(TexelFormat::rgba8);
  TwinStage stage({{light}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(scene, kSceneVertex, kSceneFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", scene.clip_from_world);
               for (std::size_t i = 0; i < scene.lights.size(); ++i) {
                 const std::string place = '[' + std::to_string(i) + ']';
                 set(("lights" + place).c_str(), scene.lights[i]);
                 set(("colors" + place).c_str(), scene.colors[i]);
               }
             });
  stage.run();
  const ToneMap tone{{}, light.view<TextureKind::two_d>(), sampler, 0.8f};
  draw_full_screen({{picture}}, tone, kToneFragment, [&](const UniformSetter& set) {
    set("light", light, sampler);
    set("exposure", tone.exposure);
  });
  expect_same_picture(picture, {1, 0.002, "halves round differently in their last bit, and edges move by up to 1/256 px"});
}

}  // namespace halfspace::test::ported::hdr
