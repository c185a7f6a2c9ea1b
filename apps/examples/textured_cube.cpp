// SPDX-License-Identifier: Apache-2.0
//
// Draws a textured cube with a perspective camera.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture.h"

using namespace halfspace;

struct TexturedShader {
  glm::mat4 clip_from_object;
  const Texture2D* texture;  // must stay alive until Pass::run returns

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
    out.uv = in.uv;
    return clip_from_object * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    // The screen-space derivatives of uv select the mip level.
    return {texture->sample<R>(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv))};
  }
};

int main(int argc, char** argv) try {
  Image<glm::u8vec4> checkers(64, 64);
  for (int i = 0; i < 64 * 64; ++i)
    checkers.at(i % 64, i / 64) = (i % 64 / 8 + i / 512) % 2 == 0 ? glm::u8vec4(230, 180, 60, 255) : glm::u8vec4(40, 60, 120, 255);
  const Texture2D texture(checkers, TexelFormat::srgb8a8);
  const Mesh mesh = cube(1.0f);
  // Multiply matrices in double and round the product to float once. Reversed Z maps the near plane to depth 1 and the far plane to 0.
  const glm::mat4 camera(perspective_reversed(0.7, 640.0 / 480.0, 0.1, 100.0) * look_at({1.4, 1.2, 1.9}, {0, 0, 0}, {0, 1, 0}));

  Image<glm::u8vec4> image(640, 480);
  Pass pass(640, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  DrawState state = kReversedZState;
  state.cull = CullMode::back;
  pass.draw(TexturedShader{camera, &texture}, make_vertex_view(stream(mesh.positions), stream(mesh.uvs)), mesh.indices, state);
  pass.run(Workers(Workers::cores()));
  write_image(argc > 1 ? argv[1] : "textured_cube.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
