// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "scenes/garden_parts.h"

namespace halfspace::garden {

namespace {

constexpr int kSides = 8;
constexpr double kEaves = 3.1;
constexpr double kBar = 0.06, kRidge = kHouseSize.y + 1.2;

glm::dvec3 pavilion_corner(double side, double radius, double y) {
  const SinCosDouble a = sincos_turns((side + 0.5) / kSides);
  return {radius * a.cos, y, -radius * a.sin};
}

// Adds a bar with a square section between two points.
void add_bar(SceneShape& shape, glm::dvec3 from, glm::dvec3 to, double width) {
  const glm::dvec3 along = glm::normalize(to - from), aside(std::abs(along.z) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  const glm::dvec3 a = glm::normalize(glm::cross(along, aside)), b = glm::cross(along, a);
  SceneShape box;
  const double length = glm::length(to - from);
  add_box(box, {0, 0, 0}, {width, width, length}, 2.0);
  add_shape(shape, box, glm::dmat4(glm::dvec4(a, 0), glm::dvec4(b, 0), glm::dvec4(along, 0), glm::dvec4(0.5 * (from + to), 1)));
}

// Corner k of gable frame i: the feet, the eaves and the ridge, from left to right.
constexpr int kFrames = 8;
glm::dvec3 frame_point(int i, int k) {
  const double x = 0.5 * kHouseSize.x, z = kHouseSize.z * (static_cast<double>(i) / (kFrames - 1) - 0.5);
  const std::array<glm::dvec3, 5> points{{{-x, 0, z}, {-x, kHouseSize.y, z}, {0, kRidge, z}, {x, kHouseSize.y, z}, {x, 0, z}}};
  return points[static_cast<std::size_t>(k)];
}

SceneShape pane(glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up) {
  SceneShape shape;
  add_surface(shape, 2, 2, {1, 1}, [=](double u, double v) { return corner + u * right + v * up; });
  return shape;
}

}  // namespace

SceneShape pavilion_stone() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 6> kFloor{
      {{3.3, -0.3}, {3.3, 0.2}, {2.95, 0.2}, {2.95, kPavilionFloor}, {1.0, kPavilionFloor}, {0.0, kPavilionFloor}}};
  add_lathe(shape, kFloor, 64, {12, 3});
  constexpr std::array<glm::dvec2, 9> kColumn{
      {{0.2, 0.0}, {0.2, 0.12}, {0.15, 0.18}, {0.13, 0.25}, {0.14, 0.9}, {0.11, 2.2}, {0.15, 2.3}, {0.2, 2.38}, {0.2, 2.5}}};
  SceneShape column;
  add_lathe(column, kColumn, 32, {1, 2}, true);
  for (int i = 0; i < kSides; ++i) add_shape(shape, column, placed(pavilion_corner(i, kPavilionRadius, kPavilionFloor)));
  for (int i = 0; i < kSides; ++i) {
    const glm::dvec3 a = pavilion_corner(i, kPavilionRadius, kEaves), b = pavilion_corner(i + 1, kPavilionRadius, kEaves);
    add_bar(shape, a, b, 0.26);
  }
  return shape;
}

SceneShape pavilion_roof() {
  SceneShape shape;
  add_surface(shape, 64, 14, {10, 4}, [](double u, double v) {
    const SinCosDouble a = sincos_turns(u);
    const double r = 3.3 * (1 - v) + 0.02;
    return glm::dvec3(r * a.cos, kEaves + 0.05 + 1.5 * v + 0.5 * v * v, -r * a.sin);
  });
  add_surface(shape, 64, 4, {10, 2}, [](double u, double v) {
    const SinCosDouble a = sincos_turns(-u);
    const double r = 3.28 * (1 - v) + 0.02;
    return glm::dvec3(r * a.cos, kEaves + 0.02 + 1.4 * v, -r * a.sin);
  });
  add_torus(shape, {0, kEaves + 2.1, 0}, 0.1, 0.099, 24, 16);
  return shape;
}

SceneShape pavilion_rails() {
  SceneShape shape;
  for (int i = 0; i < kSides; ++i) {
    if (i == 7) continue;  // the entrance
    const glm::dvec3 a = pavilion_corner(i, kPavilionRadius, kPavilionFloor + 0.05),
                     b = pavilion_corner(i + 1, kPavilionRadius, kPavilionFloor + 0.05);
    add_surface(shape, 4, 1, {2, 1}, [=](double u, double v) { return glm::mix(a, b, u) + glm::dvec3(0, 0.85 * v, 0); });
  }
  return shape;
}

// Panels in a wide arc behind the garden, with their lower edges on the ground.
SceneShape fence() {
  SceneShape shape;
  constexpr int kPanels = 60;
  for (int i = 0; i < kPanels; ++i) {
    const auto corner = [i](double u) {
      const SinCosDouble a = sincos_turns(0.08 + 0.62 * (i + u) / kPanels);
      return on_ground(21.0 * a.cos, -19.0 * a.sin);
    };
    add_surface(shape, 4, 1, {2, 1}, [=](double u, double v) { return corner(1 - u) + glm::dvec3(0, 1.25 * v - 0.1, 0); });
  }
  return shape;
}

SceneShape greenhouse_frame() {
  SceneShape shape;
  for (int i = 0; i < kFrames; ++i) {
    for (int k = 0; k < 4; ++k) add_bar(shape, frame_point(i, k), frame_point(i, k + 1), kBar);
  }
  for (int k = 0; k < 5; ++k) add_bar(shape, frame_point(0, k), frame_point(kFrames - 1, k), kBar);
  for (const int k : {0, 4}) {
    const glm::dvec3 up(0, 1.0, 0);
    add_bar(shape, frame_point(0, k) + up, frame_point(kFrames - 1, k) + up, 0.7 * kBar);
  }
  for (const int i : {0, kFrames - 1}) {
    add_bar(shape, frame_point(i, 1), frame_point(i, 3), kBar);
    for (const double u : {0.2, 0.4, 0.6, 0.8}) {
      const glm::dvec3 foot = glm::mix(frame_point(i, 0), frame_point(i, 4), u);
      add_bar(shape, foot, foot + glm::dvec3(0, kHouseSize.y, 0), 0.7 * kBar);
    }
  }
  add_box(shape, {0, 0.12, 0}, {kHouseSize.x + 0.2, 0.1, kHouseSize.z + 0.2}, 1.0);
  return shape;
}

std::vector<SceneShape> greenhouse_panes() {
  std::vector<SceneShape> panes;
  for (int i = 0; i + 1 < kFrames; ++i) {
    for (int k = 0; k < 4; ++k)
      panes.push_back(pane(frame_point(i, k), frame_point(i + 1, k) - frame_point(i, k), frame_point(i, k + 1) - frame_point(i, k)));
  }
  for (const int i : {0, kFrames - 1}) {
    for (int k = 0; k < 5; ++k) {
      if (i == kFrames - 1 && k == 2) continue;  // the door
      const glm::dvec3 side = (frame_point(i, 4) - frame_point(i, 0)) / 5.0;
      panes.push_back(pane(frame_point(i, 0) + side * static_cast<double>(k), side, {0, kHouseSize.y, 0}));
    }
  }
  return panes;
}

SceneShape greenhouse_tables() {
  SceneShape shape;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (0.5 * kHouseSize.x - 0.65);
    add_box(shape, {x, 0.8, 0}, {0.9, 0.06, kHouseSize.z - 0.8}, 1.0);
    for (int i = 0; i < 5; ++i) {
      for (const double across : {-0.38, 0.38}) add_box(shape, {x + across, 0.45, 1.5 * (i - 2)}, {0.07, 0.7, 0.07}, 1.0);
    }
  }
  return shape;
}

}  // namespace halfspace::garden
