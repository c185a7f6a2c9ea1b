// SPDX-License-Identifier: Apache-2.0
//
// Resolves four stored samples in a shader. Left: the tone-mapped mean of the samples. Right: the mean of the tone-mapped samples, which
// keeps the edges of bright shapes smooth.
#include <cstdio>

#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;

struct Glow {
  const TextureMultisampleView* samples;  // null in the first pass, which draws bright triangles
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }
  template <class R>
  static vec4<R> tone_mapped(const vec4<R>& c) {
    return vec4<R>(c.x / (c.x + R(1)), c.y / (c.y + R(1)), c.z / (c.z + R(1)), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    if (samples == nullptr) return {vec4<R>(R(40), R(12), R(3), R(1))};
    vec4<R> mean(R(0)), mean_of_tones(R(0));
    for (int s = 0; s < 4; ++s) {
      const vec4<R> light = samples->fetch<R>({truncate_to_int(px.x), truncate_to_int(px.y), IntOf<R>(s)}, IntOf<R>(0));
      mean += light * R(0.25f);
      mean_of_tones += tone_mapped(light) * R(0.25f);
    }
    return {select(px.x < R(128), tone_mapped(mean), mean_of_tones)};
  }
};

int main(int argc, char** argv) try {
  const Workers workers(Workers::cores());
  const std::vector<glm::vec2> shapes{{-0.9f, -0.8f}, {-0.1f, 0.7f}, {-0.8f, 0.8f}, {0.1f, -0.8f}, {0.9f, 0.7f}, {0.2f, 0.8f}};
  const std::vector<glm::vec2> all{{-1, -1}, {3, -1}, {-1, 3}};
  TextureMemory light(TextureKind::multisample, TexelFormat::rgba16f, {256, 256, 4});
  Pass first(256, 256, color_target(light.level()), {}, {.samples = 4});
  first.draw(Glow{nullptr}, make_vertex_view(stream(shapes)));
  first.run(workers);
  const auto view = light.view<TextureKind::multisample>();
  Image<glm::u8vec4> image(256, 256);
  Pass second(256, 256, srgb8a8_target(image), {});
  second.draw(Glow{&view}, make_vertex_view(stream(all)));
  second.run(workers);
  write_image(argc > 1 ? argv[1] : "custom_resolve.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
