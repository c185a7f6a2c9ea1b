// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/workshop_parts.h"

namespace halfspace::workshop {

namespace {

// Adds a cylinder along x, centered at a point.
void add_roller(SceneShape& shape, glm::dvec3 center, double radius, double length, int sectors) {
  SceneShape part;
  const double half = 0.5 * length;
  add_lathe(part,
            std::array<glm::dvec2, 6>{
                {{0, -half}, {0.9 * radius, -half}, {radius, 0.05 - half}, {radius, half - 0.05}, {0.9 * radius, half}, {0, half}}},
            sectors, {3, 2});
  add_shape(shape, part, placed(center) * turned_z(-0.25));
}

}  // namespace

// The painted parts of a lathe, which is 2 m long.
SceneShape machine_body() {
  SceneShape shape;
  for (const double x : {-0.75, 0.75}) add_box(shape, {x, 0.35, 0}, {0.4, 0.7, 0.5}, 1.0);
  add_box(shape, {0, 0.76, 0}, {2.0, 0.14, 0.42}, 1.0);
  add_box(shape, {-0.75, 1.08, 0}, {0.5, 0.52, 0.46}, 1.0);
  add_box(shape, {-0.75, 1.37, 0}, {0.42, 0.06, 0.4}, 1.0);
  add_box(shape, {0.8, 0.98, 0}, {0.26, 0.3, 0.24}, 1.0);
  add_box(shape, {0.1, 0.9, 0.02}, {0.34, 0.14, 0.5}, 1.0);
  return shape;
}

SceneShape machine_steel() {
  SceneShape shape;
  add_roller(shape, {-0.44, 1.08, 0}, 0.16, 0.14, 48);
  add_roller(shape, {-0.36, 1.08, 0}, 0.1, 0.16, 40);
  add_roller(shape, {0.08, 1.08, 0}, 0.05, 0.9, 32);
  add_roller(shape, {0.6, 1.08, 0}, 0.04, 0.2, 24);
  add_roller(shape, {1.02, 1.0, 0}, 0.03, 0.2, 24);
  for (const double z : {-0.16, 0.16}) add_box(shape, {0.1, 0.85, z}, {1.7, 0.05, 0.06}, 2.0);
  add_box(shape, {0.12, 1.02, 0.08}, {0.1, 0.1, 0.16}, 2.0);
  SceneShape hand_wheel;
  add_torus(hand_wheel, {0, 0, 0}, 0.11, 0.014, 40, 10);
  for (int i = 0; i < 3; ++i)
    add_shape(
        hand_wheel,
        [] {
          SceneShape s;
          add_box(s, {0, 0, 0}, {0.21, 0.014, 0.02}, 4.0);
          return s;
        }(),
        placed({0, 0, 0}, i / 6.0));
  add_shape(shape, hand_wheel, placed({0.1, 0.86, 0.3}) * turned_x(0.25));
  add_shape(shape, hand_wheel, placed({1.12, 1.0, 0}) * turned_z(-0.25));
  return shape;
}

// A hand cart without its wheels.
SceneShape cart_body() {
  SceneShape shape;
  for (int i = 0; i < 6; ++i) add_box(shape, {0, 0.62, 0.17 * (i - 2.5)}, {2.0, 0.05, 0.16}, 1.0);
  for (const double z : {-0.52, 0.52}) {
    for (int i = 0; i < 3; ++i) add_box(shape, {0, 0.72 + 0.15 * i, z}, {2.0, 0.12, 0.04}, 1.0);
    for (const double x : {-0.9, 0.0, 0.9}) add_box(shape, {x, 0.82, z * 1.08}, {0.07, 0.5, 0.05}, 1.0);
  }
  for (int i = 0; i < 3; ++i) add_box(shape, {-1.0, 0.72 + 0.15 * i, 0}, {0.04, 0.12, 1.0}, 1.0);
  for (const double x : {-0.65, 0.65}) add_box(shape, {x, 0.52, 0}, {0.1, 0.1, 1.2}, 1.0);
  for (const double z : {-0.3, 0.3}) add_box(shape, {1.5, 0.6, z}, {1.1, 0.06, 0.06}, 1.0);
  add_box(shape, {2.0, 0.6, 0}, {0.06, 0.06, 0.7}, 1.0);
  return shape;
}

// Stands on the floor, with its axis along z. Its radius is 0.5.
SceneShape wheel() {
  SceneShape flat;
  add_lathe(
      flat,
      std::array<glm::dvec2, 9>{
          {{0.4, 0.04}, {0.4, -0.04}, {0.44, -0.045}, {0.48, -0.04}, {0.5, -0.03}, {0.5, 0.03}, {0.48, 0.04}, {0.44, 0.045}, {0.4, 0.04}}},
      64, {16, 1});
  add_lathe(flat, std::array<glm::dvec2, 6>{{{0, -0.1}, {0.06, -0.1}, {0.08, -0.06}, {0.08, 0.06}, {0.06, 0.1}, {0, 0.1}}}, 28, {3, 1});
  SceneShape spoke;
  add_lathe(spoke, std::array<glm::dvec2, 5>{{{0.024, 0.07}, {0.016, 0.14}, {0.02, 0.25}, {0.016, 0.34}, {0.024, 0.41}}}, 12, {1, 2}, true);
  for (int i = 0; i < 10; ++i) add_shape(flat, spoke, placed({0, 0, 0}, i / 10.0) * turned_z(-0.25));
  SceneShape shape;
  add_shape(shape, flat, placed({0, 0.5, 0}) * turned_x(0.25));
  return shape;
}

SceneShape stool() {
  SceneShape shape;
  add_lathe(shape, std::array<glm::dvec2, 6>{{{0, 0.66}, {0.17, 0.66}, {0.19, 0.68}, {0.19, 0.71}, {0.17, 0.73}, {0, 0.73}}}, 40, {3, 1});
  for (int i = 0; i < 4; ++i) {
    const SinCosDouble a = sincos_turns(0.25 * i + 0.125);
    add_tube(
        shape, 10, 4, {1, 2}, [=](double v) { return glm::dvec3((0.24 - 0.11 * v) * a.cos, 0.68 * v, (0.24 - 0.11 * v) * a.sin); },
        [](double) { return 0.018; });
  }
  add_torus(shape, {0, 0.25, 0}, 0.21, 0.012, 40, 8);
  return shape;
}

// Leans towards −z.
SceneShape ladder() {
  SceneShape flat, shape;
  for (const double x : {-0.24, 0.24}) add_box(flat, {x, 1.6, 0}, {0.05, 3.2, 0.08}, 1.0);
  for (int i = 0; i < 10; ++i) add_box(flat, {0, 0.3 + 0.3 * i, 0}, {0.46, 0.035, 0.05}, 1.0);
  add_shape(shape, flat, turned_x(-0.035));
  return shape;
}

SceneShape lamp_shade() {
  SceneShape shape;
  add_lathe(
      shape,
      std::array<glm::dvec2, 8>{{{0.3, 0.0}, {0.31, 0.0}, {0.22, 0.12}, {0.08, 0.2}, {0.05, 0.28}, {0.01, 0.29}, {0.01, 1.4}, {0.0, 1.4}}},
      40, {3, 1});
  add_lathe(shape, std::array<glm::dvec2, 4>{{{0.05, 0.19}, {0.2, 0.115}, {0.29, 0.005}, {0.3, 0.0}}}, 40, {3, 1});
  return shape;
}

SceneShape lamp_bulb() {
  SceneShape shape;
  add_torus(shape, {0, 0.07, 0}, 0.04, 0.039, 24, 14);
  return shape;
}

}  // namespace halfspace::workshop
