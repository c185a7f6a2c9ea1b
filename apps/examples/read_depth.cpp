// SPDX-License-Identifier: Apache-2.0
//
// Reads back the depth buffer and converts depth to distance along the view axis.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct PositionShader {
  glm::mat4 clip_from_object;

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return clip_from_object * vec4<R>(in.position, R(1));
  }
};

int main(int argc, char** argv) try {
  constexpr double near = 0.5, far = 20.0;
  const Mesh ball = uv_sphere(64, 128, 1.0f);
  const glm::dmat4 camera = perspective_reversed(0.8, 1.0, near, far) * look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});

  Image<float> depth(256, 256);
  Pass pass(256, 256, {}, d32f_target(depth, 0.0f));  // cleared to 0, which is the far plane with reversed Z
  pass.draw_depth(PositionShader{glm::mat4(camera)}, make_vertex_view(stream(ball.positions)), ball.indices, kReversedZState);
  pass.run(Workers(Workers::cores()));

  // The inverse of depth = near·(far − z) / (z·(far − near)), where z is the distance along the view axis.
  const auto distance = [&](float d) { return near * far / (static_cast<double>(d) * (far - near) + near); };
  std::printf("distance at the center: %.4f\n", distance(depth.at(128, 128)));
  Image<glm::u8vec4> image(256, 256);
  std::ranges::transform(depth.texels(), image.data(), [&](float d) {
    const auto gray = static_cast<uint8_t>(std::clamp(255.0 * (4.0 - distance(d)) + 0.5, 0.0, 255.0));
    return glm::u8vec4(gray, gray, gray, 255);
  });
  write_image(argc > 1 ? argv[1] : "read_depth.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
