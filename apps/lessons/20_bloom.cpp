// SPDX-License-Identifier: Apache-2.0
//
// Lesson 20: draws into a texture, and adds a blurred copy of its bright parts in two more passes.
#include <cstdio>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;
constexpr int kWidth = 320, kHeight = 240;
constexpr TextureKind kKind = TextureKind::two_d;
constexpr Sampler kClamped{.wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};  // beyond the border is the texel at the border

struct LanternShader {  // the first pass: lamps on a string
  glm::mat4 clip_from_world;
  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec3<R> offset, light;  // one per lamp
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return clip_from_world * vec4<R>(in.position + in.offset, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.light * (R(0.3f) + R(0.7f) * max(in.normal.z, R(0))), R(1))};
  }
};
struct FullScreen {  // one triangle that covers the picture
  template <class R>
  struct Attributes {
    vec2<R> uv;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return vec4<R>(in.uv.x * R(2) - R(1), in.uv.y * R(2) - R(1), R(0), R(1));
  }
};
struct Blur : FullScreen {  // a weighted mean of 33 texels in a row or in a column
  Texture2DView source;
  glm::vec2 step;   // from one texel to the next
  float threshold;  // only light above it glows
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const auto bright = [&](const R& light) { return max(light - R(threshold), R(0)); };
    vec3<R> sum(R(0));
    for (int i = -16; i <= 16; ++i) {
      const vec4<R> light = source.sample_level(kClamped, in.uv + vec2<R>(step * static_cast<float>(i)), R(0));
      const float t = 1 - static_cast<float>(i * i) / 289;  // 1 in the middle, and 0 at a distance of 17 texels
      sum += vec3<R>(bright(light.x), bright(light.y), bright(light.z)) * R(t * t / 18.13f);
    }
    return {vec4<R>(sum, R(1))};
  }
};
struct Combine : Blur {  // the second blur, and the tone curve of lesson 12
  Texture2DView scene;
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> light(scene.sample_level(kClamped, in.uv, R(0)) + Blur::fragment<R>(in).color);
    return {vec4<R>(light / (light + vec3<R>(R(1))), R(1))};
  }
};

int main(int argc, char** argv) try {
  const Mesh ball = icosphere(3, 0.22f);
  std::vector<glm::vec3> offsets, lights;
  for (int i = 0; i < 15; ++i) {
    const float x = static_cast<float>(i - 7) * 0.45f;
    offsets.emplace_back(x, 0.12f * x * x - 0.9f + static_cast<float>(i % 3) * 0.6f, 0.0f);
    lights.push_back(i % 2 == 0 ? glm::vec3(12, 5, 1) : glm::vec3(0.5f, 0.4f, 0.3f));
  }
  const glm::mat4 camera(perspective_reversed(0.6, 4.0 / 3.0, 0.1, 100.0) * look_at({2.5, 0.4, 6.5}, {0, 0, 0}, {0, 1, 0}));
  const std::vector<glm::vec2> triangle{{0, 0}, {2, 0}, {0, 2}};
  TextureMemory scene(kKind, TexelFormat::rgba16f, {kWidth, kHeight}), rows(kKind, TexelFormat::rgba16f, {kWidth, kHeight});
  Image<glm::u8vec4> image(kWidth, kHeight);
  Pass first(kWidth, kHeight, color_target(scene.level()), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  first.clear({.colors = {glm::vec4(0.005f, 0.005f, 0.02f, 1)}});
  first.draw(LanternShader{camera},
             make_vertex_view(stream(ball.positions), stream(ball.normals), per_instance(stream(offsets)), per_instance(stream(lights))),
             ball.indices, {.instances = 15, .depth = kReversedZ});
  Pass second(kWidth, kHeight, color_target(rows.level()), {});
  second.draw(Blur{{}, scene.view<kKind>(), {1.0f / kWidth, 0}, 1.0f}, make_vertex_view(stream(triangle)));
  Pass third(kWidth, kHeight, srgb8a8_target(image), {});
  third.draw(Combine{{{}, rows.view<kKind>(), {0, 1.0f / kHeight}, 0.0f}, scene.view<kKind>()}, make_vertex_view(stream(triangle)));
  for (Pass* const pass : {&first, &second, &third}) pass->run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson20.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
