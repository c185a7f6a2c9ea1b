// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "scenes/hall_parts.h"

namespace halfspace::hall {

namespace {

// Adds a flat roof surface between two edges, each from z = −length to z = length. The front face is up.
void add_slope(SceneShape& shape, glm::dvec2 left, glm::dvec2 right, double length) {
  const double width = glm::length(right - left);
  add_surface(shape, 4, 16, {0.4 * width, 0.8 * length}, [=](double u, double v) {
    const glm::dvec2 at = glm::mix(left, right, u);
    return glm::dvec3(at.x, at.y, length * (1 - 2 * v));
  });
}

}  // namespace

SceneShape arched(const ArchedWall& wall) {
  SceneShape shape;
  add_arched_wall(shape, wall);
  return shape;
}

SceneShape end_wall(double door_radius, double door_spring) {
  SceneShape shape;
  constexpr double kScale = 0.5, kThick = 0.8, kMiddle = 8.0;
  if (door_radius > 0) {
    add_arched_wall(shape, {2 * kNave, kMiddle, kThick, door_radius, 0, door_spring});
  } else {
    add_box(shape, {0, 0.5 * kMiddle, 0}, {2 * kNave, kMiddle, kThick}, kScale);
  }
  SceneShape upper;
  add_arched_wall(upper, {2 * kNave, 8.4, kThick, 2.0, 1.0, 4.0});
  add_shape(shape, upper, placed({0, kMiddle, 0}));
  for (const double side : {-1.0, 1.0}) {
    add_box(shape, {side * 0.5 * (kNave + kAisle), 0.5 * (kAisleHeight + 1.4), 0}, {kAisle - kNave + 0.7, kAisleHeight + 1.4, kThick},
            kScale);
    add_box(shape, {side * (kNave + 0.6), 9.0, 0.2}, {1.2, 18.0, 1.4}, kScale);
  }
  return shape;
}

SceneShape vault() {
  SceneShape shape;
  add_surface(shape, 48, 4 * kBays, {6, 3.0 * kBays}, [](double u, double v) {
    const SinCosDouble a = sincos_turns(0.5 * u);
    return glm::dvec3(-kNave * a.cos, kVaultSpring + kNave * a.sin, kEnd * (2 * v - 1));
  });
  return shape;
}

SceneShape vault_ribs() {
  SceneShape shape;
  for (int i = 0; i <= kBays; ++i) {
    add_surface(shape, 12, 48, {1, 8}, [=](double u, double v) {
      const SinCosDouble around = sincos_turns(u), along = sincos_turns(0.5 * v);
      const double r = kNave - 0.05 + 0.22 * around.cos;
      return glm::dvec3(r * along.cos, kVaultSpring + r * along.sin, bay_edge(i) - 0.25 * around.sin);
    });
  }
  return shape;
}

SceneShape floor_plane() {
  SceneShape shape;
  add_surface(shape, 18, 36, {6, 12}, [](double u, double v) { return glm::dvec3(kAisle * (2 * u - 1), 0.0, kEnd * (1 - 2 * v)); });
  return shape;
}

SceneShape aisle_ceilings() {
  SceneShape shape;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * 0.5 * (kNave + kAisle);
    add_box(shape, {x, kAisleHeight, 0}, {kAisle - kNave, 0.12, 2 * kEnd}, 0.4);
    for (int i = 0; i <= 3 * kBays; ++i) {
      add_box(shape, {x, kAisleHeight - 0.2, -kEnd + kBay / 3 * i}, {kAisle - kNave, 0.3, 0.22}, 1.0);
    }
  }
  return shape;
}

SceneShape roofs() {
  SceneShape shape;
  const double length = kEnd + 0.3;
  add_slope(shape, {-kNave - 0.9, kEaves}, {0, kRoofRidge}, length);
  add_slope(shape, {0, kRoofRidge}, {kNave + 0.9, kEaves}, length);
  add_slope(shape, {-kAisle - 0.8, kAisleHeight + 0.1}, {-kNave, 8.3}, length);
  add_slope(shape, {kNave, 8.3}, {kAisle + 0.8, kAisleHeight + 0.1}, length);
  return shape;
}

SceneShape buttresses() {
  SceneShape shape;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i <= kBays; ++i) {
      add_box(shape, {side * (kAisle + 0.7), 2.2, bay_edge(i)}, {0.9, 4.4, 0.8}, 0.5);
      add_box(shape, {side * (kAisle + 0.5), 5.0, bay_edge(i)}, {0.5, 1.4, 0.7}, 0.5);
    }
  }
  return shape;
}

// A base, and a shaft with flutes that is thickest in its lower third.
SceneShape column_shape() {
  SceneShape shape;
  add_box(shape, {0, 0.15, 0}, {1.2, 0.3, 1.2});
  add_torus(shape, {0, 0.38, 0}, 0.47, 0.09, 48, 10);
  add_torus(shape, {0, 0.53, 0}, 0.44, 0.06, 48, 10);
  add_surface(shape, 144, 14, {3, 4}, [](double u, double v) {
    const SinCosDouble a = sincos_turns(u), flute = sincos_turns(24 * u);
    const double r = (0.42 - 0.06 * v * v) * (1.0 + 0.03 * flute.cos);
    return glm::dvec3(r * a.cos, 0.56 + (kSpring - 1.1) * v, -r * a.sin);
  });
  return shape;
}

// A bell with two rows of leaves in relief, and a slab.
SceneShape capital_shape() {
  SceneShape shape;
  add_torus(shape, {0, kSpring - 0.55, 0}, 0.38, 0.05, 48, 8);
  for (int row = 0; row < 2; ++row) {
    add_surface(shape, 96, 8, {3, 0.5}, [row](double u, double v) {
      const SinCosDouble a = sincos_turns(u), leaf = sincos_turns(8 * u + 0.5 * row);
      const double height = 0.5 * (row + v);
      const double r = 0.36 + 0.2 * height * height + 0.09 * v * v * std::max(leaf.cos, 0.0);
      return glm::dvec3(r * a.cos, kSpring - 0.55 + 0.4 * height, -r * a.sin);
    });
  }
  add_box(shape, {0, kSpring - 0.08, 0}, {1.25, 0.16, 1.25});
  return shape;
}

SceneShape window_pane(double radius, double base, double spring) {
  SceneShape shape;
  add_surface(shape, 12, 12, {1, (spring + radius - base) / (2 * radius)}, [=](double u, double v) {
    const double x = radius * (2 * u - 1), top = spring + std::sqrt(std::max(radius * radius - x * x, 0.0));
    return glm::dvec3(x, base + (top - base) * v, 0);
  });
  return shape;
}

}  // namespace halfspace::hall
