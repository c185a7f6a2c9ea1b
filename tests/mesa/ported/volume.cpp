// SPDX-License-Identifier: Apache-2.0
//
// A cloud in a 3D texture, drawn as slices from back to front.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::volume {

// [volume]
struct Slices {
  glm::mat4 clip_from_world;
  float slices;
  Texture3DView density;
  Sampler sampler;  // bilinear in each slice, and between slices

  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec3<R> uvw;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    const R depth((static_cast<float>(id.instance) + 0.5f) / slices);
    out.uvw = vec3<R>(in.position, depth);
    return clip_from_world * vec4<R>(out.uvw - 0.5f, R(1));
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const R alpha = density.sample_level(sampler, in.uvw, R(0)).x;
    return {vec4<R>(mix(glm::vec3(0.2f, 0.3f, 0.9f), glm::vec3(1.0f, 0.9f, 0.7f), in.uvw.z), 0.5f * alpha), alpha >= R(0.02f)};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec2 position;
uniform mat4 clip_from_world;
uniform float slices;
out vec3 uvw;

void main() {
  float depth = (float(gl_InstanceID) + 0.5) / slices;
  uvw = vec3(position, depth);
  gl_Position = clip_from_world * vec4(uvw - 0.5, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 uvw;
uniform sampler3D density;
out vec4 color;

void main() {
  float alpha = textureLod(density, uvw, 0.0).r;
  if (alpha < 0.02) discard;
  color = vec4(mix(vec3(0.2, 0.3, 0.9), vec3(1.0, 0.9, 0.7), uvw.z), 0.5 * alpha);
}
)glsl";

TEST_F(Ported, VolumeSlices) {
  TwinTexture density(TextureKind::three_d, TexelFormat::r8, {24, 20, 16});
  density.fill([](int x, int y, int z) {
    const glm::vec3 p = (glm::vec3(x, y, z) + 0.5f) / glm::vec3(24, 20, 16) - glm::vec3(0.55f, 0.45f, 0.5f);
    const float waves = 0.5f + 0.5f * std::sin(20.0f * p.x) * std::cos(17.0f * p.y + 9.0f * p.z);
    return glm::vec4(std::clamp(1.0f - 2.2f * glm::length(p), 0.0f, 1.0f) * waves);
  });
  const std::vector<glm::vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  constexpr Sampler sampler{
      .mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp, .wrap_r = Wrap::clamp};
  const Slices shader{camera({0.5f, 0.4f, 1.5f}), 24.0f, density.view<TextureKind::three_d>(), sampler};
  // With 8 bits, the two differ by up to 6 codes after 24 blended layers.
  Flat2D layers(TexelFormat::rgba16f), picture(TexelFormat::rgba8);
  TwinStage stage({{layers, glm::vec4(0, 0, 0, 1)}});
  DrawState state = kAlphaBlendState;
  state.depth.test = false;
  state.instances = 24;
  stage.draw(
      shader, kVertex, kFragment, make_vertex_view(stream(square)), kNoIndices,
      [&](const UniformSetter& set) {
        set("clip_from_world", shader.clip_from_world);
        set("slices", shader.slices);
        set("density", density, shader.sampler);
      },
      state);
  stage.run();
  draw_full_screen({{picture}}, Copy{{}, layers.view<TextureKind::two_d>()}, kCopyFragment,
                   [&](const UniformSetter& set) { set("image", layers, {.mag = Filter::nearest, .min = Filter::nearest}); });
  expect_same_picture(picture, {2, 0.0, "each of 24 layers is rounded to a half, by up to 0.06 codes"});
}

}  // namespace halfspace::test::ported::volume
