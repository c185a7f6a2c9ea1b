// SPDX-License-Identifier: Apache-2.0
//
// Lesson 16: a teapot is stored as 24 curved patches of 16 points. Tessellation divides them into triangles: the nearer, the more.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct PatchShader {
  static constexpr TessellationLayout tessellation_layout{.patch_vertices = 16, .domain = TessellationDomain::quads};
  glm::mat4 clip_from_world;
  glm::vec3 offset, eye;

  template <class R>
  struct Attributes {
    vec3<R> point;
  };
  template <class R>
  struct Varyings {
    vec3<R> position;  // in the world
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position = in.point + vec3<R>(offset);
    return vec4<R>(out.position, R(1));
  }
  // Runs once per patch. Each lane of R is a patch.
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 16>& in) const {
    const auto level = [&](std::size_t i, std::size_t step) {  // of the edge with the points i, i + step, i + 2 step, i + 3 step
      const auto point = [&](std::size_t k) { return in.varyings[i + k * step].position; };
      const R edge_length = length(point(1) - point(0)) + length(point(2) - point(1)) + length(point(3) - point(2));
      return max(R(16) * edge_length / length(point(0) - vec3<R>(eye)), R(1));
    };
    const R left = level(0, 4), bottom = level(0, 1), right = level(3, 4), top = level(12, 1);
    return {.outer = {left, bottom, right, top}, .inner = {max(bottom, top), max(left, right)}};
  }
  // Runs once per vertex of the divided patch, which is at u = at.x and v = at.y.
  template <class R>
  vec4<R> evaluate(const PatchInput<R, Varyings<R>, 16>& in, const vec3<R>& at, Varyings<R>& out) const {
    const auto bernstein = [](const R& t, const R& s) { return std::array{s * s * s, R(3) * s * s * t, R(3) * s * t * t, t * t * t}; };
    const std::array<R, 4> u = bernstein(at.x, R(1) - at.x), v = bernstein(at.y, R(1) - at.y);
    out.position = vec3<R>(R(0));
    for (std::size_t i = 0; i < 16; ++i) out.position += in.varyings[i].position * (u[i % 4] * v[i / 4]);
    return clip_from_world * vec4<R>(out.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const vec3<R> normal = normalize(cross(px.ddx(&Varyings<R>::position), px.ddy(&Varyings<R>::position)));  // flat, as in lesson 8
    const R diffuse = max(dot(normal, vec3<R>(glm::normalize(glm::vec3(-1, 2, 2)))), R(0));
    return {vec4<R>(vec3<R>(glm::vec3(0.8f, 0.35f, 0.15f)) * (R(0.1f) + R(0.9f) * diffuse), R(1))};
  }
};

using Ring = std::vector<glm::dvec3>;
Ring circle(double r, double y) {  // four arcs of four points, which share their ends
  const double k = 0.56 * r;
  return {{r, y, 0},  {r, y, k},   {k, y, r},   {0, y, r},  {-k, y, r}, {-r, y, k},
          {-r, y, 0}, {-r, y, -k}, {-k, y, -r}, {0, y, -r}, {k, y, -r}, {r, y, -k}};
}
Ring oval(double x0, double y0, double x1, double y1, double z = 0.3) {  // two arcs
  return {{x0, y0, 0}, {x0, y0, z}, {x1, y1, z}, {x1, y1, 0}, {x1, y1, -z}, {x0, y0, -z}};
}
// Adds the patches of a tube. Each has four points of each of four rings, and neighbors share the points of an edge.
void add_tube(std::vector<glm::vec3>& points, const std::vector<Ring>& rings) {
  for (std::size_t row = 0; row + 3 < rings.size(); row += 3)
    for (std::size_t arc = 0; arc < rings[row].size(); arc += 3)
      for (std::size_t i = 0; i < 16; ++i) points.emplace_back(rings[row + i / 4][(arc + i % 4) % rings[row].size()]);
}

int main(int argc, char** argv) try {
  std::vector<glm::vec3> teapot;  // after the teapot of Martin Newell, 1975
  add_tube(teapot,
           {circle(0, 3.15), circle(0.8, 3.15), circle(0, 2.85), circle(0.2, 2.7), circle(0.4, 2.55), circle(1.3, 2.55), circle(1.5, 2.4),
            circle(1.75, 1.875), circle(2, 1.35), circle(2, 0.9), circle(2, 0.45), circle(1.5, 0.225), circle(1.5, 0.15)});
  add_tube(teapot, {oval(-1.6, 2.025, -1.5, 2.25), oval(-2.3, 2.025, -2.5, 2.25), oval(-2.7, 2.025, -3, 2.25), oval(-2.7, 1.8, -3, 1.8),
                    oval(-2.7, 1.575, -3, 1.35), oval(-2.5, 1.125, -2.65, 0.9375), oval(-2, 0.9, -1.9, 0.6)});
  add_tube(teapot, {oval(1.7, 1.425, 1.7, 0.6, 0.66), oval(2.6, 1.425, 3.1, 0.825, 0.66), oval(2.3, 2.1, 2.4, 2.025, 0.25),
                    oval(2.7, 2.4, 3.3, 2.4, 0.25), oval(2.8, 2.475, 3.525, 2.49375, 0.25), oval(2.9, 2.475, 3.45, 2.5125, 0.15),
                    oval(2.8, 2.4, 3.2, 2.4, 0.15)});

  const glm::vec3 eye(0, 4, 9);
  const glm::mat4 camera(perspective_reversed(0.55, 400.0 / 180.0, 0.1, 100.0) * look_at(glm::dvec3(eye), {0.35, 1.25, 0}, {0, 1, 0}));
  Image<glm::u8vec4> image(400, 180);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.05f, 0.15f, 1};
  Pass pass(400, 180, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const glm::vec3& offset : {glm::vec3(-1.5f, 0, 1), glm::vec3(2.5f, 0, -5), glm::vec3(10, 0, -18)})
    pass.draw(PatchShader{camera, offset, eye}, make_vertex_view(stream(teapot)),
              {.topology = Topology::patches, .cull = CullMode::back, .depth = kReversedZ});
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson16.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
