// SPDX-License-Identifier: Apache-2.0
//
// Multisample antialiasing: draws the same star with 1 sample per pixel (left) and with 4 (right).
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>

#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct WhiteShader {
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
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(1))};
  }
};

int main(int argc, char** argv) try {
  const Workers workers(Workers::cores());
  std::vector<glm::vec2> star;  // seven thin triangles around the center
  for (int i = 0; i < 7; ++i) {
    const float a = 0.1f + 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / 7.0f;
    const glm::vec2 tip(0.9f * std::cos(a), 0.9f * std::sin(a)), side(-0.1f * std::sin(a), 0.1f * std::cos(a));
    for (const glm::vec2 p : {tip, side, -side}) star.push_back(p);
  }

  Image<glm::u8vec4> image(512, 256);
  for (const int samples : {1, 4}) {
    ColorTarget color = srgb8a8_target(image);
    color.load = samples == 1 ? LoadOp::clear : LoadOp::load;  // the second pass keeps the result of the first
    color.clear_value = {0, 0, 0, 1};
    Pass pass(512, 256, color, {}, {.samples = samples});
    pass.draw(WhiteShader{}, make_vertex_view(stream(star)), {.viewport = Rect{samples == 1 ? 0 : 256, 0, 256, 256}});
    pass.run(workers);
  }
  write_image(argc > 1 ? argv[1] : "msaa.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
