// SPDX-License-Identifier: Apache-2.0
//
// Renders into a half-float texture, computes its mip levels, samples it in a second pass, and tone-maps the result.
#include <cstdio>

#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"
#include "halfspace/shading/values/tone.h"

using namespace halfspace;

struct GlowShader {
  const Texture2DView* texture;  // null in the first pass, which draws a bright disk in the upper left
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.position * R(0.5f) + vec2<R>(R(0.5f));
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const R disk = select(length(in.uv - vec2<R>(R(0.35f), R(0.7f))) < R(0.2f), R(1), R(0));
    if (texture == nullptr) return {vec4<R>(R(4) * disk, R(2) * disk, disk, R(1))};
    vec4<R> glow(R(0));  // average four mip levels, a cheap blur
    for (const float level : {1.0f, 2.0f, 3.0f, 4.0f}) glow += texture->sample_level(Sampler{}, in.uv, R(level));
    return {glow * R(0.25f)};
  }
};

int main(int argc, char** argv) try {
  const Workers workers(Workers::cores());
  const std::vector<glm::vec2> full_screen{{-1, -1}, {3, -1}, {-1, 3}};
  TextureMemory light(TextureKind::two_d, TexelFormat::rgba16f, {256, 256}, 5);
  Pass first(256, 256, color_target(light.level()), {});
  first.draw(GlowShader{nullptr}, make_vertex_view(stream(full_screen)));
  first.run(workers);
  light.generate_mipmaps(&workers);
  const auto texture = light.view<TextureKind::two_d>();
  Image<glm::u8vec4> image(256, 256);
  Pass second(256, 256, {.format = ColorFormat::rgba16f, .store = StoreOp::dont_care}, {});
  second.draw(GlowShader{&texture}, make_vertex_view(stream(full_screen)));
  const auto reinhard = []<class R>(const vec4<R>& c) {
    return vec4<R>(tone_map(SceneLight<R>{vec3<R>(c.x, c.y, c.z)}, ToneMapping{.curve = ToneCurve::reinhard}).rgb, R(1));
  };
  second.post(reinhard, srgb8a8_target(image));  // runs for each finished pixel while its tile is in cache
  second.run(workers);
  write_image(argc > 1 ? argv[1] : "render_to_texture.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
