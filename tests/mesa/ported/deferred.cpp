// SPDX-License-Identifier: Apache-2.0
//
// Deferred shading: a pass with three color attachments, and one that lights their texels.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::deferred {

// [gbuffer]
struct GBuffer {
  glm::mat4 clip_from_world;

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
  FragmentMRT<R, 3> fragment(const Varyings<R>& in) const {
    const vec3<R> albedo = fract(in.world_position) * 0.7f + 0.2f;
    return {{vec4<R>(in.world_position, R(1)), vec4<R>(normalize(in.world_normal), R(0)), vec4<R>(albedo, R(1))}};
  }
};
// [end]

constexpr const char* kGBufferVertex = R"glsl(#version 330 core
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

constexpr const char* kGBufferFragment = R"glsl(#version 330 core
in vec3 world_position;
in vec3 world_normal;
layout(location = 0) out vec4 g_position;
layout(location = 1) out vec4 g_normal;
layout(location = 2) out vec4 g_albedo;

void main() {
  g_position = vec4(world_position, 1.0);
  g_normal = vec4(normalize(world_normal), 0.0);
  g_albedo = vec4(fract(world_position) * 0.7 + 0.2, 1.0);
}
)glsl";

// [deferred_lighting]
struct DeferredLighting : FullScreen {
  Texture2DView g_position, g_normal, g_albedo;
  std::array<glm::vec3, 4> lights, colors;

  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const ivec3<R> texel(truncate_to_int(px.x), truncate_to_int(px.y), IntOf<R>(0));
    const vec4<R> position = g_position.fetch<R>(texel);
    const vec3<R> normal(g_normal.fetch<R>(texel)), albedo(g_albedo.fetch<R>(texel));
    vec3<R> sum = albedo * 0.05f;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const vec3<R> to_light = lights[i] - vec3<R>(position);
      const R distance = length(to_light);
      const R fall_off = 1.0f / (1.0f + 0.7f * distance + 1.8f * distance * distance);
      sum += albedo * colors[i] * (max(dot(normal, to_light / distance), R(0)) * fall_off);
    }
    return {vec4<R>(sum, R(1)), position.w != R(0)};
  }
};
// [end]

constexpr const char* kLightingFragment = R"glsl(#version 330 core
uniform sampler2D g_position, g_normal, g_albedo;
uniform vec3 lights[4], colors[4];
out vec4 color;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 position = texelFetch(g_position, texel, 0);
  if (position.w == 0.0) discard;
  vec3 normal = texelFetch(g_normal, texel, 0).xyz;
  vec3 albedo = texelFetch(g_albedo, texel, 0).rgb;
  vec3 sum = albedo * 0.05;
  for (int i = 0; i < 4; ++i) {
    vec3 to_light = lights[i] - position.xyz;
    float distance = length(to_light);
    float fall_off = 1.0 / (1.0 + 0.7 * distance + 1.8 * distance * distance);
    sum += albedo * colors[i] * (max(dot(normal, to_light / distance), 0.0) * fall_off);
  }
  color = vec4(sum, 1.0);
}
)glsl";

TEST_F(Ported, DeferredGBufferAndLighting) {
  const Mesh mesh = still_life();
  const GBuffer geometry{camera({1.5, 2.0, 3.0}, {0, 0.3, 0})};
  Flat2D position(TexelFormat::rgba16f), normal(TexelFormat::rgba16f), albedo(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{position}, {normal}, {albedo}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(geometry, kGBufferVertex, kGBufferFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) { set("clip_from_world", geometry.clip_from_world); });
  stage.run();

  const DeferredLighting lighting{{},
                                  position.view<TextureKind::two_d>(),
                                  normal.view<TextureKind::two_d>(),
                                  albedo.view<TextureKind::two_d>(),
                                  {glm::vec3(1.5f, 1, 1), glm::vec3(-1.5f, 0.8f, 1), glm::vec3(0, 1.6f, -0.5f), glm::vec3(0, 0.4f, 1.2f)},
                                  {glm::vec3(3, 1, 1), glm::vec3(1, 3, 1), glm::vec3(1, 1, 4), glm::vec3(1.5f)}};
  Flat2D picture(TexelFormat::rgba8);
  draw_full_screen({{picture, glm::vec4(0.1f, 0.1f, 0.2f, 1.0f)}}, lighting, kLightingFragment, [&](const UniformSetter& set) {
    const Sampler nearest{.mag = Filter::nearest, .min = Filter::nearest};
    set("g_position", position, nearest);
    set("g_normal", normal, nearest);
    set("g_albedo", albedo, nearest);
    for (std::size_t i = 0; i < lighting.lights.size(); ++i) {
      const std::string place = '[' + std::to_string(i) + ']';
      set(("lights" + place).c_str(), lighting.lights[i]);
      set(("colors" + place).c_str(), lighting.colors[i]);
    }
  });
  expect_same_picture(picture, {1, 0.002, "halves round differently in their last bit, fract jumps, and edges move by up to 1/256 px"});
}

}  // namespace halfspace::test::ported::deferred
