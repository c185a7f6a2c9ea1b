// SPDX-License-Identifier: Apache-2.0
//
// Lesson 17: with several samples per pixel, the color of a pixel at an edge is a mixture.
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kWidth = 320, kHeight = 240, kSpokes = 64;

struct SpokeShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position, color;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

void draw(Image<glm::u8vec4>& image, const PassOptions& options) {
  // A wheel of thin triangles. Each begins at the hub with no width.
  std::vector<glm::vec3> positions, colors;
  for (int i = 0; i < kSpokes; ++i) {
    const double angle = 6.283185307179586 * i / kSpokes, width = 6.283185307179586 * 0.25 / kSpokes;
    positions.emplace_back(0, 0, 0);
    positions.emplace_back(std::cos(angle - width), std::sin(angle - width), 0);
    positions.emplace_back(std::cos(angle + width), std::sin(angle + width), 0);
    for (int k = 0; k < 3; ++k) colors.push_back(i % 8 == 0 ? glm::vec3(0.9f, 0.25f, 0.1f) : glm::vec3(0.85f, 0.85f, 0.8f));
  }
  const double aspect = static_cast<double>(kWidth) / kHeight;
  const glm::dmat4 camera = perspective_reversed(0.6, aspect, 0.1, 100.0) * look_at({1.5, -1.7, 3.2}, {0, 0, 0}, {0, 1, 0});

  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(image.width(), image.height(), color, {.format = DepthFormat::d32f, .clear_value = 0.0f}, options);
  pass.draw(SpokeShader{glm::mat4(camera)}, make_vertex_view(stream(positions), stream(colors)), kReversedZState);
  pass.run(Workers(1));
}

int main(int argc, char** argv) try {
  Image<glm::u8vec4> image(kWidth, kHeight);
  draw(image, {.samples = 4});
  write_image(argc > 1 ? argv[1] : "lesson17.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
