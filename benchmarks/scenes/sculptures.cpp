// SPDX-License-Identifier: Apache-2.0
#include "scenes/sculptures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "scenes/mesh_order.h"

namespace halfspace {

namespace {

// Adds a surface with about this number of triangles. shape_ratio: columns per row.
void add_fine_surface(SceneShape& shape, double triangles, double columns_per_row, glm::dvec2 repeats, const SurfaceFunction& point) {
  const int rows = std::max(static_cast<int>(std::sqrt(0.5 * triangles / columns_per_row) + 0.5), 4);
  const int columns = std::max(static_cast<int>(0.5 * triangles / rows + 0.5), 4);
  add_surface(shape, columns, rows, repeats, point);
}

// A Catmull-Rom spline through equidistant values, for t from 0 to 1. It continues as a line.
double spline(std::span<const double> values, double t) {
  const int last = static_cast<int>(values.size()) - 1;
  const double at = t * last;
  const int i = std::clamp(static_cast<int>(std::floor(at)), 0, last - 1);
  const auto value = [&](int k) {
    if (k < 0) return 2 * values[0] - values[1];
    if (k > last) return 2 * values[static_cast<std::size_t>(last)] - values[static_cast<std::size_t>(last) - 1];
    return values[static_cast<std::size_t>(k)];
  };
  const double f = at - i, a = value(i - 1), b = value(i), c = value(i + 1), d = value(i + 2);
  return b + 0.5 * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The tool marks of a sculptor: roughly in [−1, 1], with a period of about 1/`frequency`.
double tool_marks(const glm::dvec3& p, double frequency) {
  const SinCosDouble a = sincos_turns(frequency * (p.x + 0.7 * p.y)), b = sincos_turns(frequency * (0.6 * p.y - 0.9 * p.z + 0.3 * p.x)),
                     c = sincos_turns(1.7 * frequency * (p.z + 0.5 * p.y - 0.4 * p.x));
  return 0.4 * (a.sin * b.cos + b.sin * c.cos + c.sin * a.cos);
}

// A smooth bump of height 1 at (x, y), for directions that face +z.
double bump(const glm::dvec3& d, glm::dvec2 at, glm::dvec2 width) {
  if (d.z <= 0) return 0;
  const glm::dvec2 q = (glm::dvec2(d) - at) / width;
  const double f = 1 + glm::dot(q, q);
  return d.z / (f * f);
}

// Distance of the surface of a head from its center, in direction d, relative to an ellipsoid.
double head_radius(const glm::dvec3& d) {
  double r = 1.0;
  r += 0.22 * bump(d, {0, -0.16}, {0.12, 0.24}) + 0.05 * bump(d, {0, -0.28}, {0.2, 0.09});  // nose
  r += 0.05 * bump(d, {0, 0.26}, {0.6, 0.1});                                               // brow
  for (const double side : {-1.0, 1.0}) {
    r -= 0.11 * bump(d, {side * 0.33, 0.1}, {0.2, 0.13});  // eyes
    r += 0.07 * bump(d, {side * 0.33, 0.09}, {0.1, 0.06});
    r += 0.05 * bump(d, {side * 0.5, -0.25}, {0.25, 0.25});  // cheeks
  }
  r += 0.06 * bump(d, {0, -0.47}, {0.22, 0.05}) + 0.05 * bump(d, {0, -0.58}, {0.18, 0.05});  // lips
  r += 0.1 * bump(d, {0, -0.8}, {0.25, 0.16});                                               // chin
  const double hair = smooth(0.35, 0.55, d.y - 0.55 * d.z + 0.1);
  const SinCosDouble wave = sincos_turns(2.5 * d.y + 1.5 * d.z), lock = sincos_turns(9 * d.x + 0.8 * wave.sin),
                     strand = sincos_turns(45 * d.x + 4 * wave.sin);
  return r + hair * (0.1 + 0.04 * lock.cos + 0.01 * strand.cos);
}

// The head's size is that of a figure of 1.75 units.
void add_head(SceneShape& shape, double triangles, const glm::dvec3& center, double scale) {
  add_fine_surface(shape, triangles, 1.3, {2, 1}, [=](double u, double v) {
    const SinCosDouble around = sincos_turns(u), up = sincos_turns(0.5 * (v - 0.5));
    const glm::dvec3 d(up.cos * around.cos, up.sin, -up.cos * around.sin);
    const double r = head_radius(d) + 0.0008 * tool_marks(d, 20);
    return center + scale * r * d * glm::dvec3(0.084, 0.122, 0.098);
  });
}

glm::dvec3 robe_point(double u, double v) {
  constexpr std::array kHeight{0.0, 0.13, 0.27, 0.41, 0.55, 0.69, 0.83, 0.97, 1.11, 1.24, 1.34, 1.40, 1.44, 1.50};
  constexpr std::array kWidth{0.36, 0.33, 0.30, 0.28, 0.275, 0.28, 0.255, 0.225, 0.235, 0.265, 0.235, 0.13, 0.066, 0.06};
  constexpr std::array kDepth{0.33, 0.29, 0.26, 0.24, 0.22, 0.215, 0.19, 0.165, 0.175, 0.17, 0.13, 0.09, 0.064, 0.06};
  const double y = spline(kHeight, v), neck = smooth(0.78, 0.9, v), waist = smooth(0.35, 0.6, v);
  const SinCosDouble around = sincos_turns(u), twice = sincos_turns(2 * u + 0.4 * v), sway = sincos_turns(0.6 * v);
  const SinCosDouble fall = sincos_turns(15 * u + 0.35 * twice.sin + 0.5 * v), fine = sincos_turns(34 * u + 0.8 * fall.sin + 2.2 * v);
  const SinCosDouble drape = sincos_turns(11 * v - 2 * u + 0.3 * twice.cos), weave = sincos_turns(60 * v + 6 * around.sin);
  const double falling = (1 - waist) * (0.10 * fall.cos + 0.035 * (2 * fall.cos * fall.cos - 1) + 0.02 * fine.cos);
  const double draped = waist * (1 - neck) * (0.05 * drape.cos + 0.02 * fine.cos + 0.006 * weave.cos);
  const double r = 1 + falling + draped;
  return {0.03 * sway.sin + spline(kWidth, v) * r * around.cos, y, -spline(kDepth, v) * r * around.sin};
}

void add_arm(SceneShape& shape, double triangles, const std::array<glm::dvec3, 4>& joints) {
  std::array<std::array<double, 4>, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < 4; ++k) axes[axis][k] = joints[k][static_cast<int>(axis)];
  }
  const int rows = std::max(static_cast<int>(std::sqrt(0.5 * triangles / 0.6) + 0.5), 4);
  add_tube(
      shape, static_cast<int>(0.6 * rows), rows, {1, 2},
      [=](double v) { return glm::dvec3(spline(axes[0], v), spline(axes[1], v), spline(axes[2], v)); },
      [](double v) {
        const double sleeve = 1 - smooth(0.55, 0.6, v), hand = smooth(0.86, 0.93, v);
        const SinCosDouble folds = sincos_turns(13 * v);
        const double arm = 0.062 - 0.024 * v + 0.022 * sleeve * (1 + 0.3 * folds.cos) + 0.012 * hand;
        return arm * std::sqrt(std::max(1 - smooth(0.93, 1.0, v), 1e-4));
      });
}

}  // namespace

SceneShape statue(int triangles) {
  SceneShape shape;
  const double n = triangles;
  add_fine_surface(shape, 0.64 * n, 1.6, {6, 4}, [](double u, double v) {
    const glm::dvec3 p = robe_point(u, v);
    return p + 0.0008 * tool_marks(p, 30) * glm::dvec3(1, 0, 1);
  });
  add_head(shape, 0.2 * n, {0.01, 1.58, 0.02}, 1.0);
  add_arm(shape, 0.07 * n, {{{-0.1, 1.26, 0.0}, {-0.42, 1.28, 0.08}, {-0.5, 1.55, 0.14}, {-0.46, 1.83, 0.16}}});
  add_arm(shape, 0.07 * n, {{{0.1, 1.26, 0.0}, {0.33, 1.06, 0.0}, {0.28, 0.92, 0.19}, {0.06, 0.98, 0.25}}});
  add_fine_surface(shape, 0.02 * n, 6.0, {4, 1}, [](double u, double v) {
    const SinCosDouble around = sincos_turns(u), half = sincos_turns(0.25 * v);
    const double r = 0.42 * (v < 1 ? std::sqrt(std::max(half.cos, 0.0)) : 0.0);
    return glm::dvec3(r * around.cos, 0.06 * half.sin, -r * around.sin);
  });
  order_by_cells(shape);
  return shape;
}

SceneShape bust(int triangles) {
  SceneShape shape;
  constexpr std::array kProfile{0.27, 0.28, 0.24, 0.13, 0.12, 0.16, 0.32, 0.35, 0.24, 0.13, 0.115, 0.12};
  add_fine_surface(shape, 0.35 * triangles, 1.5, {3, 2}, [=](double u, double v) {
    const SinCosDouble around = sincos_turns(u), folds = sincos_turns(12 * u + 2 * v);
    const double cloth = smooth(0.5, 0.6, v) * (1 - smooth(0.72, 0.8, v));
    const double r = spline(kProfile, v) * (1 + 0.06 * cloth * folds.cos);
    return glm::dvec3(r * around.cos, 0.68 * v, -(0.75 + 0.25 * (1 - cloth)) * r * around.sin);
  });
  add_head(shape, 0.65 * triangles, {0, 0.78, 0.02}, 1.8);
  order_by_cells(shape);
  return shape;
}

SceneShape vase(int triangles) {
  SceneShape shape;
  constexpr std::array kProfile{0.02, 0.2, 0.17, 0.19, 0.29, 0.36, 0.38, 0.34, 0.25, 0.15, 0.12, 0.14, 0.22};
  add_fine_surface(shape, triangles, 2.0, {3, 3}, [=](double u, double v) {
    const SinCosDouble around = sincos_turns(u), flutes = sincos_turns(28 * u), meander = sincos_turns(12 * u), rows = sincos_turns(30 * v);
    const double low = smooth(0.2, 0.24, v) * (1 - smooth(0.4, 0.44, v)), band = smooth(0.5, 0.52, v) * (1 - smooth(0.6, 0.62, v));
    const double r = spline(kProfile, v) * (1 + 0.03 * low * flutes.cos + 0.025 * band * meander.cos * rows.cos);
    const glm::dvec3 p(r * around.cos, v, -r * around.sin);
    return p + 0.001 * tool_marks(p, 14) * glm::dvec3(around.cos, 0, -around.sin);
  });
  order_by_cells(shape);
  return shape;
}

SceneShape boulder(int triangles) {
  SceneShape shape;
  add_fine_surface(shape, triangles, 2.0, {4, 2}, [](double u, double v) {
    const SinCosDouble around = sincos_turns(u), up = sincos_turns(0.5 * (v - 0.5));
    const glm::dvec3 d(up.cos * around.cos, up.sin, -up.cos * around.sin);
    double r = 0.42, height = 0.09;
    for (double frequency = 0.55; frequency < 40; frequency *= 2.1) {
      r += height * tool_marks(d + glm::dvec3(0.37, 0.11, 0.53) * frequency, frequency);
      height *= 0.52;
    }
    return glm::dvec3(0, 0.46, 0) + r * d * glm::dvec3(1.15, 1.0, 0.95);
  });
  order_by_cells(shape);
  return shape;
}

SceneShape shell(int triangles) {
  SceneShape shape;
  constexpr double kWhorls = 5.0;
  add_fine_surface(shape, triangles, 0.1, {1, 12}, [](double u, double v) {
    // A tube whose radius and distance from the axis grow along a conical spiral.
    const double size = 0.03 + 0.97 * v * v;
    const SinCosDouble turn = sincos_turns(kWhorls * v), tube = sincos_turns(u), ribs = sincos_turns(60 * v), lines = sincos_turns(18 * u);
    const double r = 0.26 * size * (1 + 0.04 * ribs.cos + 0.015 * lines.cos), axis = 0.27 * size;
    const double out = axis + r * tube.cos;
    return glm::dvec3(out * turn.cos, 0.3 + 0.7 * (1 - size) + r * tube.sin, out * turn.sin);
  });
  order_by_cells(shape);
  return shape;
}

}  // namespace halfspace
