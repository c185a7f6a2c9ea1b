// SPDX-License-Identifier: Apache-2.0
//
// Lesson 7: far away, a pixel covers many texels of a texture. Mip levels store their averages.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture.h"

using namespace halfspace;

struct TexturedShader {
  glm::mat4 clip_from_world;
  const Texture2D* texture;
  Sampler sampler;

  template <class R>
  struct Attributes {
    vec3<R> position;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv * R(60);  // the texture repeats 60 times
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    // The changes of uv to the pixels on the right and above give the size of a pixel on the texture, which selects the mip level.
    const vec2<R> across = px.ddx(&Varyings<R>::uv), up = px.ddy(&Varyings<R>::uv);
    return {texture->sample<R>(sampler, in.uv, across, up)};
  }
};

int main(int argc, char** argv) try {
  Image<glm::u8vec4> checks(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      checks.at(x, y) = (x / 32 + y / 32) % 2 == 0 ? glm::u8vec4(230, 180, 60, 255) : glm::u8vec4(40, 60, 120, 255);
  const Texture2D texture(checks, TexelFormat::srgb8a8);  // generates the mip levels

  const Mesh floor = plane(100.0f);
  const glm::dmat4 camera = perspective_reversed(0.9, 320.0 / 240.0, 0.1, 200.0) * look_at({0, 1.5, 0}, {0, 1, -3}, {0, 1, 0});
  Sampler sampler;  // trilinear: interpolates within a level and between levels
  sampler.anisotropy = 1;

  Image<glm::u8vec4> image(320, 240);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(TexturedShader{glm::mat4(camera), &texture, sampler}, make_vertex_view(stream(floor.positions), stream(floor.uvs)),
            floor.indices, kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson07.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
