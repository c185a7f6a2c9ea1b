// SPDX-License-Identifier: Apache-2.0
//
// Bloom: the bright parts of a picture are blurred between two textures in turn, and added to it.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::bloom {

// [bloom_bright]
struct Bright : FullScreen {  // two attachments: the picture, and its bright parts
  template <class R>
  FragmentMRT<R, 2> fragment(const Varyings<R>& in) const {
    const vec2<R> p = fract(in.uv * 4.0f) - 0.5f;
    const R lamp = (1.0f - smoothstep(0.2f, 0.25f, length(p))) * 2.0f;
    const vec3<R> color = vec3<R>(in.uv, 1.0f - in.uv.x) * (0.2f + lamp * in.uv.y);
    const R luminance = dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    return {{vec4<R>(color, R(1)), vec4<R>(color * smoothstep(0.4f, 0.8f, luminance), R(1))}};
  }
};
// [end]
constexpr const char* kBrightFragment = R"glsl(#version 330 core
in vec2 uv;
layout(location = 0) out vec4 picture;
layout(location = 1) out vec4 bright;

void main() {
  vec2 p = fract(uv * 4.0) - 0.5;
  float lamp = (1.0 - smoothstep(0.2, 0.25, length(p))) * 2.0;
  vec3 color = vec3(uv, 1.0 - uv.x) * (0.2 + lamp * uv.y);
  float luminance = dot(color, vec3(0.2126, 0.7152, 0.0722));
  picture = vec4(color, 1.0);
  bright = vec4(color * smoothstep(0.4, 0.8, luminance), 1.0);
}
)glsl";

// [bloom_blur]
struct Blur : FullScreen {
  Texture2DView image;
  Sampler sampler;  // bilinear, clamped
  glm::vec2 step;   // one texel to the right, or one up

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    constexpr std::array<float, 5> weights{0.227027f, 0.1945946f, 0.1216216f, 0.054054f, 0.016216f};
    vec3<R> sum = vec3<R>(image.sample_level(sampler, in.uv, R(0))) * weights[0];
    for (std::size_t i = 1; i < weights.size(); ++i) {
      const vec2<R> offset = step * static_cast<float>(i);
      sum += vec3<R>(image.sample_level(sampler, in.uv + offset, R(0))) * weights[i];
      sum += vec3<R>(image.sample_level(sampler, in.uv - offset, R(0))) * weights[i];
    }
    return {vec4<R>(sum, R(1))};
  }
};
// [end]
constexpr const char* kBlurFragment = R"glsl(#version 330 core
in vec2 uv;
uniform sampler2D image;
uniform vec2 step;
out vec4 color;

const float weights[5] = float[](0.227027, 0.1945946, 0.1216216, 0.054054, 0.016216);

void main() {
  vec3 sum = texture(image, uv).rgb * weights[0];
  for (int i = 1; i < 5; ++i) {
    vec2 offset = step * float(i);
    sum += texture(image, uv + offset).rgb * weights[i];
    sum += texture(image, uv - offset).rgb * weights[i];
  }
  color = vec4(sum, 1.0);
}
)glsl";

// [bloom_add]
struct AddBloom : FullScreen {
  Texture2DView picture, bloom;
  Sampler sampler;

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> color(picture.sample_level(sampler, in.uv, R(0)) + bloom.sample_level(sampler, in.uv, R(0)));
    return {vec4<R>(1.0f - exp(-color), R(1))};
  }
};
// [end]
constexpr const char* kAddFragment = R"glsl(#version 330 core
in vec2 uv;
uniform sampler2D picture, bloom;
out vec4 color;

void main() {
  vec3 sum = texture(picture, uv).rgb + texture(bloom, uv).rgb;
  color = vec4(vec3(1.0) - exp(-sum), 1.0);
}
)glsl";

TEST_F(Ported, BloomWithPingPongTargets) {
  constexpr Sampler sampler{.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  Flat2D scene(TexelFormat::rgba16f), ping(TexelFormat::rgba16f), pong(TexelFormat::rgba16f), picture(TexelFormat::rgba8);
  draw_full_screen({{scene}, {ping}}, Bright{}, kBrightFragment, [](const UniformSetter&) {});
  // [bloom_passes]
  for (int i = 0; i < 4; ++i) {  // to the right from ping to pong, then up from pong to ping
    for (const bool up : {false, true}) {
      Flat2D &from = up ? pong : ping, &to = up ? ping : pong;
      const glm::vec2 step = (up ? glm::vec2(0, 1) : glm::vec2(1, 0)) / static_cast<float>(kSize);
      const Blur blur{{}, from.view<TextureKind::two_d>(), sampler, step};
      draw_full_screen({{to}}, blur, kBlurFragment, [&](const UniformSetter& set) {
        set("image", from, sampler);
        set("step", step);
      });
    }
  }
  // [end]
  const AddBloom add{{}, scene.view<TextureKind::two_d>(), ping.view<TextureKind::two_d>(), sampler};
  draw_full_screen({{picture}}, add, kAddFragment, [&](const UniformSetter& set) {
    set("picture", scene, sampler);
    set("bloom", ping, sampler);
  });
  expect_same_picture(picture, {1, 0.0, "nine passes round to halves, with a relative error of up to 2^-12 each"});
}

}  // namespace halfspace::test::ported::bloom
