// SPDX-License-Identifier: Apache-2.0
//
// Lesson 18: glass mixes its color with what is behind it, so panes must be drawn from the farthest to the nearest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct ColorShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position;
    vec4<R> color;  // the last component is the opacity, alpha
  };
  template <class R>
  struct Varyings {
    vec4<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {in.color};
  }
};

struct Pane {
  glm::vec3 corners[4];
  glm::vec4 color;
};

// A pane between two points on the floor.
Pane upright(const glm::vec3& from, const glm::vec3& to, const glm::vec4& color) {
  const glm::vec3 up(0, 1.8f, 0);
  return {{from, to, to + up, from + up}, color};
}

std::vector<Pane> make_panes() {
  std::vector<Pane> panes;
  const glm::vec4 colors[]{{0.9f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.7f, 0.15f, 0.5f}, {0.1f, 0.3f, 0.95f, 0.5f}};
  for (int i = 0; i < 3; ++i) {  // three panes around the center; each turns its broad side to it
    const float angle = 0.4f + 2.0943951f * static_cast<float>(i);
    const glm::vec3 center(std::sin(angle), 0, std::cos(angle)), along(std::cos(angle), 0, -std::sin(angle));
    panes.push_back(upright(center - along, center + along, colors[i]));
  }
  return panes;
}

int main(int argc, char** argv) try {
  const glm::dvec3 eye(0.6, 2.4, 5.2);
  const glm::mat4 camera(perspective_reversed(0.7, 320.0 / 240.0, 0.1, 100.0) * look_at(eye, {0, 0.7, 0}, {0, 1, 0}));
  Mesh ball = icosphere(4, 0.5f);
  for (glm::vec3& p : ball.positions) p.y += 0.7f;
  std::vector<glm::vec4> ball_colors;
  for (const glm::vec3& normal : ball.normals) ball_colors.emplace_back(glm::vec3(0.1f + 0.8f * std::max(normal.y, 0.0f)), 1);

  std::vector<Pane> panes = make_panes();
  const auto distance = [&](const Pane& p) { return glm::distance(glm::vec3(eye), (p.corners[0] + p.corners[2]) * 0.5f); };
  std::ranges::sort(panes, [&](const Pane& a, const Pane& b) { return distance(a) > distance(b); });  // the farthest first
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;
  for (const Pane& p : panes)
    for (const int corner : {0, 1, 2, 0, 2, 3}) {
      positions.push_back(p.corners[corner]);
      colors.push_back(p.color);
    }

  Image<glm::u8vec4> image(320, 240);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(ColorShader{camera}, make_vertex_view(stream(ball.positions), stream(ball_colors)), ball.indices, kReversedZState);
  DrawState glass = kReversedZState;
  glass.blend = BlendState{};  // color · alpha + the color of the pixel · (1 - alpha)
  glass.depth.write = false;   // a pane hides nothing behind it
  pass.draw(ColorShader{camera}, make_vertex_view(stream(positions), stream(colors)), glass);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson18.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
