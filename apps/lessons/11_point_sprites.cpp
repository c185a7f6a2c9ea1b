// SPDX-License-Identifier: Apache-2.0
//
// Lesson 11: a sphere without triangles. A point covers a square; the fragment function keeps a disk and computes its normal and depth.
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kWidth = 320, kHeight = 240;
constexpr float kNear = 0.1f, kRadius = 0.35f, kFov = 0.7f;

struct SphereShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> center, color;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
    R distance;  // along the view axis
  };
  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position = clip_from_world * vec4<R>(in.center, R(1));
    out = {in.color, position.w};
    const R pixels = R(2 * kRadius * 0.5f * kHeight / std::tan(0.5f * kFov)) / position.w;  // the projected diameter
    return {position, pixels, {}};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> coordinate = px.point_coord();  // 0 to 1 over the square, from its upper left corner
    const R x = coordinate.x * R(2) - R(1), y = R(1) - coordinate.y * R(2);
    const R squared = x * x + y * y;
    const R z = sqrt(max(R(1) - squared, R(0)));  // toward the eye
    const R diffuse = max(dot(vec3<R>(x, y, z), vec3<R>(glm::normalize(glm::vec3(-1, 2, 2)))), R(0));
    const R depth = R(kNear) / (in.distance - z * R(kRadius));  // reversed Z: near / distance, for a far plane at infinity
    return {vec4<R>(in.color * (R(0.1f) + R(0.9f) * diffuse), R(1)), squared <= R(1), depth};
  }
};

int main(int argc, char** argv) try {
  std::vector<glm::vec3> centers, colors;
  for (int i = 0; i < 24; ++i) {  // two strands of a helix; the spheres are so close that neighbors intersect
    const double angle = 0.5 * (i / 2) + (i % 2) * 3.141592653589793;
    centers.emplace_back(std::cos(angle), 0.22 * (i / 2) - 1.2, std::sin(angle));
    colors.push_back(i % 2 == 0 ? glm::vec3(0.9f, 0.4f, 0.2f) : glm::vec3(0.3f, 0.5f, 0.9f));
  }
  const double aspect = static_cast<double>(kWidth) / kHeight;
  const glm::dmat4 camera = perspective_reversed(static_cast<double>(kFov), aspect, static_cast<double>(kNear), INFINITY) *
                            look_at({0, 0.5, 5}, {0, 0, 0}, {0, 1, 0});

  Image<glm::u8vec4> image(kWidth, kHeight);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(kWidth, kHeight, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  DrawState state = kReversedZState;
  state.topology = Topology::points;
  pass.draw(SphereShader{glm::mat4(camera)}, make_vertex_view(stream(centers), stream(colors)), state);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson11.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
