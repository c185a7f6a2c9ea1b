// SPDX-License-Identifier: Apache-2.0
//
// Divides a bicubic Bézier patch of 16 control points into triangles, with tessellation.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
struct BezierPatch {
  glm::mat4 clip_from_world;
  static constexpr TessellationLayout tessellation_layout{.patch_vertices = 16, .domain = TessellationDomain::quads};
  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  struct VertexVaryings {};  // control points have only a position
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>&) const {
    return vec4<R>(in.position, R(1));
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, VertexVaryings<R>, 16>&) const {
    return {.outer = {R(16), R(16), R(16), R(16)}, .inner = {R(16), R(16)}};  // segments of the four edges, and inside
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, VertexVaryings<R>, 16>& in, const vec3<R>& at, Varyings<R>& out) const {
    const auto bernstein = [](const R& t, const R& s) { return std::array{s * s * s, R(3) * s * s * t, R(3) * s * t * t, t * t * t}; };
    const std::array<R, 4> u = bernstein(at.x, R(1) - at.x), v = bernstein(at.y, R(1) - at.y);
    vec4<R> p(R(0));
    for (std::size_t i = 0; i < 16; ++i) p = p + in.position[i] * (u[i % 4] * v[i / 4]);
    out.color = vec3<R>(at.x, p.y * R(0.5f) + R(0.5f), at.y);
    return clip_from_world * p;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.color, R(1))};
  }
};

int main(int, char** argv) try {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 16; ++i) points.emplace_back(i % 4 - 1.5, 0.6 * ((i % 4) * (i % 4 - 3) - i / 4 * (i / 4 - 3)), i / 4 - 1.5);
  const glm::mat4 camera(perspective_reversed(0.8, 1.0, 0.1, 100.0) * look_at({2, 3, 4}, {0, 0, 0}, {0, 1, 0}));
  Image<glm::u8vec4> image(480, 480);
  Pass pass(480, 480, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(BezierPatch{camera}, make_vertex_view(stream(points)), {.topology = Topology::patches, .depth = kReversedZ});
  pass.run(Workers(Workers::cores()));
  write_image(argv[1] != nullptr ? argv[1] : "curved_patch.png", image);
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
