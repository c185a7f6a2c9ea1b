// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/hall_parts.h"

namespace halfspace::hall {

SceneShape stairs() {
  SceneShape shape;
  constexpr int kSteps = 8;
  for (int i = 0; i < kSteps; ++i) {
    const double height = kDais / kSteps, front = kDaisFront + 0.35 * (kSteps - i - 1);
    add_box(shape, {0, height * (i + 0.5), 0.5 * (front - kEnd)}, {2 * kNave - 1.2, height, front + kEnd}, 0.7);
    add_box(shape, {0, height * (i + 1) - 0.02, front}, {2 * kNave - 1.1, 0.04, 0.06}, 0.7);
  }
  return shape;
}

SceneShape carpet_runner() {
  SceneShape shape;
  add_surface(shape, 4, 60, {1, 10},
              [](double u, double v) { return glm::dvec3(1.1 * (2 * u - 1), 0.02, kEnd - 0.6 + (kDaisFront + 2.5 - kEnd + 0.6) * v); });
  add_surface(shape, 4, 10, {1, 2},
              [](double u, double v) { return glm::dvec3(1.1 * (2 * u - 1), kDais + 0.02, kDaisFront + (2.2 - kEnd - kDaisFront) * v); });
  return shape;
}

SceneShape bench_shape() {
  SceneShape shape;
  add_box(shape, {0, 0.45, 0}, {2.6, 0.06, 0.42}, 1.5);
  for (int i = 0; i < 3; ++i) add_box(shape, {0, 0.62 + 0.15 * i, 0.24 + 0.02 * i}, {2.6, 0.1, 0.03}, 1.5);
  for (const double x : {-1.25, 0.0, 1.25}) {
    add_box(shape, {x, 0.22, -0.15}, {0.08, 0.44, 0.08}, 1.5);
    add_box(shape, {x, 0.5, 0.22}, {0.08, 1.0, 0.08}, 1.5);
  }
  return shape;
}

SceneShape baluster_shape() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 14> kProfile{{{0.07, 0.0},
                                                 {0.07, 0.06},
                                                 {0.035, 0.1},
                                                 {0.05, 0.16},
                                                 {0.075, 0.26},
                                                 {0.07, 0.36},
                                                 {0.045, 0.46},
                                                 {0.03, 0.56},
                                                 {0.03, 0.64},
                                                 {0.05, 0.68},
                                                 {0.03, 0.72},
                                                 {0.04, 0.8},
                                                 {0.07, 0.84},
                                                 {0.07, 0.9}}};
  add_lathe(shape, kProfile, 20, {1, 1}, true);
  return shape;
}

SceneShape handrail() {
  SceneShape shape;
  add_box(shape, {0, 0.05, 0}, {3.0, 0.1, 0.2}, 1.5);
  for (const double x : {-1.55, 1.55}) {
    add_box(shape, {x, -0.35, 0}, {0.24, 1.1, 0.24}, 1.5);
    add_torus(shape, {x, 0.3, 0}, 0.07, 0.069, 20, 14);
  }
  return shape;
}

SceneShape throne() {
  SceneShape shape;
  add_box(shape, {0, 0.15, 0}, {2.4, 0.3, 1.8});
  add_box(shape, {0, 0.7, 0}, {1.0, 0.14, 0.8});
  add_box(shape, {0, 1.5, -0.4}, {1.1, 1.8, 0.12});
  for (const double x : {-0.52, 0.52}) {
    add_box(shape, {x, 0.7, 0.05}, {0.12, 0.9, 0.8});
    add_box(shape, {x, 1.6, -0.4}, {0.14, 2.2, 0.16});
    add_torus(shape, {x, 2.75, -0.4}, 0.08, 0.079, 24, 16);
  }
  return shape;
}

// Two rings that hang from chains.
SceneShape chandelier() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 5> kCandle{{{0.06, 0.0}, {0.08, 0.03}, {0.025, 0.05}, {0.025, 0.25}, {0.0, 0.25}}};
  for (int k = 0; k < 2; ++k) {
    const double radius = k == 0 ? 1.2 : 0.7, y = 0.5 * k;
    const int candles = k == 0 ? 12 : 6;
    add_torus(shape, {0, y, 0}, radius, 0.05, 64, 10);
    for (int i = 0; i < candles; ++i) {
      const SinCosDouble a = sincos_turns(static_cast<double>(i) / candles);
      SceneShape candle;
      add_lathe(candle, kCandle, 12);
      add_shape(shape, candle, placed({radius * a.cos, y + 0.04, radius * a.sin}));
      if (i % 3 != 0) continue;
      add_tube(
          shape, 6, 12, {1, 6}, [=](double v) { return glm::dvec3(radius * (1 - v) * a.cos, y + (2.6 - y) * v, radius * (1 - v) * a.sin); },
          [](double) { return 0.015; });
    }
  }
  add_box(shape, {0, 5.2, 0}, {0.04, 5.2, 0.04});
  return shape;
}

SceneShape chandelier_flames() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 6> kFlame{{{0.0, 0.26}, {0.02, 0.28}, {0.03, 0.31}, {0.02, 0.36}, {0.008, 0.41}, {0.0, 0.44}}};
  for (int i = 0; i < 18; ++i) {
    const SinCosDouble a = sincos_turns(i < 12 ? i / 12.0 : i / 6.0);
    const double radius = i < 12 ? 1.2 : 0.7, y = i < 12 ? 0.04 : 0.54;
    SceneShape flame;
    add_lathe(flame, kFlame, 8, {1, 1}, true);
    add_shape(shape, flame, placed({radius * a.cos, y, radius * a.sin}));
  }
  return shape;
}

// A cloth that hangs from a rod, with folds that are deeper at its lower end.
SceneShape banner_shape() {
  SceneShape shape;
  add_surface(shape, 16, 24, {1, 1.2}, [](double u, double v) {
    const SinCosDouble fold = sincos_turns(2.5 * u);
    return glm::dvec3(0.6 * (2 * u - 1), -2.6 * (1 - v), 0.12 * (1 - v) * fold.sin);
  });
  add_box(shape, {0, 0.02, 0}, {1.4, 0.05, 0.05});
  return shape;
}

}  // namespace halfspace::hall
