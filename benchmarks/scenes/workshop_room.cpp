// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/workshop_parts.h"

namespace halfspace::workshop {

namespace {

constexpr double kThick = 0.3, kX = 0.5 * kRoom.x, kZ = 0.5 * kRoom.z;

// An opening in a wall: the position of its center along the wall, its width, and its bottom and top edges.
struct Opening {
  double middle, width, low, high;
};
constexpr std::array<Opening, 4> kFront{{{-4.6, 2.0, 1.1, 3.2}, {-1.6, 2.0, 1.1, 3.2}, {1.4, 2.0, 1.1, 3.2}, {4.4, 2.0, 1.1, 3.2}}};
constexpr std::array<Opening, 3> kBack{{{-3.6, 1.6, 2.75, 3.6}, {0.0, 1.6, 2.75, 3.6}, {3.6, 1.6, 2.75, 3.6}}};
constexpr std::array<Opening, 1> kDoor{{{1.2, 2.8, 0.0, 2.9}}};

// Adds a wall of boxes along x, centered at the origin. The openings must be sorted.
void add_wall(SceneShape& shape, double length, std::span<const Opening> openings, const glm::dmat4& transform) {
  SceneShape wall;
  const auto piece = [&](double x0, double x1, double y0, double y1) {
    if (x1 > x0 && y1 > y0) add_box(wall, {0.5 * (x0 + x1), 0.5 * (y0 + y1), 0}, {x1 - x0, y1 - y0, kThick}, 0.5);
  };
  double from = -0.5 * length;
  for (const Opening& o : openings) {
    const double left = o.middle - 0.5 * o.width, right = o.middle + 0.5 * o.width;
    piece(from, left, 0, kRoom.y);
    piece(left, right, 0, o.low);
    piece(left, right, o.high, kRoom.y);
    from = right;
  }
  piece(from, 0.5 * length, 0, kRoom.y);
  add_shape(shape, wall, transform);
}

// Adds the frame of a window and its bars.
void add_frame(SceneShape& shape, const Opening& o, double z) {
  const double middle = 0.5 * (o.low + o.high), height = o.high - o.low;
  for (const double x : {-0.5, -0.25, 0.0, 0.25, 0.5}) add_box(shape, {o.middle + x * o.width, middle, z}, {0.06, height, 0.08});
  for (const double y : {-0.5, 0.0, 0.5}) add_box(shape, {o.middle, middle + y * height, z}, {o.width, 0.06, 0.08});
  add_box(shape, {o.middle, o.low - 0.03, z}, {o.width + 0.2, 0.05, 0.5});
}

// Calls f(opening, z) for all windows.
template <class F>
void for_each_window(const F& f) {
  for (const Opening& o : kFront) f(o, kZ);
  for (const Opening& o : kBack) f(o, -kZ);
}

}  // namespace

SceneShape walls() {
  SceneShape shape;
  add_wall(shape, kRoom.x + kThick, kFront, placed({0, 0, kZ}));
  add_wall(shape, kRoom.x + kThick, kBack, placed({0, 0, -kZ}));
  add_wall(shape, kRoom.z - kThick, kDoor, placed({-kX, 0, 0}, 0.25));
  add_wall(shape, kRoom.z - kThick, {}, placed({kX, 0, 0}, 0.25));
  return shape;
}

SceneShape room_floor() {
  SceneShape shape;
  add_surface(shape, 26, 18, {4, 3}, [](double u, double v) { return glm::dvec3(kRoom.x * (u - 0.5), 0, kRoom.z * (0.5 - v)); });
  return shape;
}

SceneShape ceiling() {
  SceneShape shape;
  add_box(shape, {0, kRoom.y + 0.06, 0}, {kRoom.x + kThick, 0.12, kRoom.z + kThick}, 0.4);
  return shape;
}

SceneShape trusses() {
  SceneShape shape;
  for (int i = -2; i <= 2; ++i) {
    const double x = 2.6 * i;
    add_box(shape, {x, kRoom.y - 0.12, 0}, {0.2, 0.24, kRoom.z}, 1.0);
    add_box(shape, {x, kRoom.y - 0.75, 0}, {0.16, 0.18, kRoom.z}, 1.0);
    for (int k = -3; k <= 3; ++k) add_box(shape, {x, kRoom.y - 0.45, 1.25 * k}, {0.1, 0.5, 0.1}, 1.0);
  }
  for (const double z : {-3.0, 0.0, 3.0}) add_box(shape, {0, kRoom.y - 0.05, z}, {kRoom.x, 0.1, 0.14}, 1.0);
  return shape;
}

SceneShape window_frames() {
  SceneShape shape;
  for_each_window([&](const Opening& o, double z) { add_frame(shape, o, z); });
  for (const double z : {-0.2, 2.6}) add_box(shape, {-kX, 1.45, -z}, {0.4, 2.9, 0.12});
  add_box(shape, {-kX, 2.96, -1.2}, {0.4, 0.12, 3.0});
  return shape;
}

std::vector<WindowPane> window_panes() {
  std::vector<WindowPane> panes;
  for_each_window([&](const Opening& o, double z) {
    const glm::dvec2 size(0.25 * o.width, 0.5 * (o.high - o.low));
    for (int i = 0; i < 8; ++i) {
      const double x = o.middle + size.x * (i % 4 - 1.5), y = o.low + size.y * (i / 4 + 0.5);
      panes.push_back({{x, y, z}, size});
    }
  });
  return panes;
}

SceneShape roof() {
  SceneShape shape;
  for (const double side : {-1.0, 1.0}) {
    add_surface(shape, 8, 8, {9, 5}, [side](double u, double v) {
      const double across = side * (1 - v);
      return glm::dvec3(side * (kRoom.x + 1.2) * (u - 0.5), kRoom.y + 0.05 + 1.9 * v, across * (kZ + 0.7));
    });
  }
  return shape;
}

SceneShape gables() {
  SceneShape shape, gable;  // a triangle, as a surface that narrows
  add_surface(gable, 8, 8, {5, 1},
              [](double u, double v) { return glm::dvec3(2 * (kZ + 0.6) * (1 - v) * (u - 0.5), kRoom.y + 1.9 * v, 0.15); });
  for (const double side : {-1.0, 1.0}) add_shape(shape, gable, placed({side * kX, 0, 0}, side * 0.25));
  return shape;
}

SceneShape workbench() {
  SceneShape shape;
  add_box(shape, {0, kBenchHeight - 0.04, 0}, {2.6, 0.08, 0.85}, 1.0);
  add_box(shape, {0, 0.25, 0}, {2.4, 0.04, 0.7}, 1.0);
  for (const double x : {-1.2, 1.2}) {
    for (const double z : {-0.34, 0.34}) add_box(shape, {x, 0.43, z}, {0.1, 0.86, 0.1}, 2.0);
  }
  for (int i = 0; i < 3; ++i) {
    add_box(shape, {0.85, 0.36 + 0.19 * i, 0.02}, {0.6, 0.17, 0.72}, 1.5);
    add_box(shape, {0.85, 0.36 + 0.19 * i, 0.4}, {0.56, 0.14, 0.04}, 1.5);
    add_box(shape, {0.85, 0.36 + 0.19 * i, 0.44}, {0.16, 0.02, 0.03}, 1.5);
  }
  return shape;
}

// Five shelves between four posts.
SceneShape rack() {
  SceneShape shape;
  for (int i = 0; i < 5; ++i) add_box(shape, {0, 0.25 + 0.55 * i, 0}, {2.2, 0.04, 0.5}, 1.0);
  for (const double x : {-1.1, 1.1}) {
    for (const double z : {-0.24, 0.24}) add_box(shape, {x, 1.3, z}, {0.05, 2.6, 0.05}, 1.0);
  }
  return shape;
}

SceneShape cage() {
  SceneShape shape;
  const auto side = [&](double turns) {
    SceneShape panel;
    add_surface(panel, 2, 3, {2, 3}, [](double u, double v) { return glm::dvec3(1.6 * (u - 0.5), 2.4 * v, 0.8); });
    add_shape(shape, panel, placed({0, 0, 0}, turns));
  };
  for (int i = 0; i < 4; ++i) side(0.25 * i);
  return shape;
}

SceneShape pegboard() {
  SceneShape shape;
  add_surface(shape, 2, 2, {8, 1.6}, [](double u, double v) { return glm::dvec3(8.6 * (u - 0.5), 1.35 * v, 0); });
  return shape;
}

SceneShape pane() {
  SceneShape shape;
  add_surface(shape, 1, 1, {1, 1}, [](double u, double v) { return glm::dvec3(u - 0.5, v - 0.5, 0); });
  return shape;
}

}  // namespace halfspace::workshop
