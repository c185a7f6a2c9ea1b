// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/scene_plants.h"
#include "scenes/street_parts.h"
#include "workloads/workload_random.h"

namespace halfspace::street {

namespace {

constexpr int kWindows = 3;  // of a floor, on each side
constexpr double kCell = kHouseWidth / kWindows, kWall = 0.4, kFront = 0.5 * kHouseDepth;
constexpr double kRadius = 0.55, kBase = 0.9, kSpring = 1.75;  // of a window
constexpr double kDoorSpring = 1.9;

// Adds a horizontal molding along x, whose front faces +z and whose back is at z.
void add_molding(SceneShape& shape, glm::dvec3 center, double width, double height, double depth, int columns) {
  add_surface(shape, columns, 12, {2 * width, 0.5}, [=](double u, double v) {
    const SinCosDouble half = sincos_turns(0.5 * v), wave = sincos_turns(1.5 * v);
    return center + glm::dvec3(width * (u - 0.5), height * (v - 0.5), depth * (half.sin + 0.15 * wave.sin));
  });
}

void add_window(HouseShape& house, double x, double y) {
  const double z = kFront - 0.5 * kWall, top = y + kSpring + kRadius;
  add_card(house.glass, {x, 0.5 * (y + kBase + top), z}, {kRadius, 0, 0}, {0, 0.5 * (top - y - kBase), 0}, {0, 0, 1});
  for (const double across : {-kRadius + 0.04, 0.0, kRadius - 0.04})
    add_box(house.wood, {x + across, 0.5 * (y + kBase + top), z + 0.03}, {0.07, top - y - kBase, 0.07}, 2.0);
  for (const double up : {kBase + 0.04, kSpring - 0.1}) add_box(house.wood, {x, y + up, z + 0.03}, {2 * kRadius, 0.07, 0.06}, 2.0);
  add_molding(house.trim, {x, y + kBase - 0.08, kFront}, 2 * kRadius + 0.3, 0.16, 0.16, 2);
  for (const double side : {-1.0, 1.0})  // shutters
    add_box(house.wood, {x + side * (kRadius + 0.33), y + 0.5 * (kBase + kSpring + 0.3), kFront + 0.03}, {0.5, kSpring + 0.3 - kBase, 0.05},
            1.0);
}

void add_door(HouseShape& house) {
  add_box(house.wood, {0, 0.5 * (kDoorSpring + 0.7), kFront - 0.25}, {1.4, kDoorSpring + 0.7, 0.08}, 1.0);
  for (int step = 0; step < 2; ++step) add_box(house.trim, {0, 0.08 - 0.08 * step, kFront + 0.3 + 0.15 * step}, {1.8, 0.16, 0.6}, 0.5);
}

void add_balcony(HouseShape& house, double y) {
  constexpr std::array<glm::dvec2, 8> kBaluster{
      {{0.05, 0.0}, {0.05, 0.08}, {0.03, 0.13}, {0.06, 0.28}, {0.055, 0.38}, {0.03, 0.6}, {0.045, 0.7}, {0.045, 0.8}}};
  constexpr double kWidth = kHouseWidth - 1.0, kReach = 1.1;
  SceneShape baluster;
  add_lathe(baluster, kBaluster, 12, {1, 1}, true);
  add_box(house.glass, {0, y + 0.5 * (kDoorSpring + 0.7), kFront - 0.25}, {1.4, kDoorSpring + 0.7, 0.08}, 1.0);
  add_box(house.trim, {0, y + 0.02, kFront + 0.5 * kReach}, {kWidth, 0.2, kReach}, 0.5);
  add_box(house.trim, {0, y + 0.96, kFront + kReach - 0.08}, {kWidth, 0.1, 0.16}, 0.5);
  constexpr int kBalusters = 24;
  for (int i = 0; i < kBalusters; ++i) {
    const double x = (kWidth - 0.2) * (static_cast<double>(i) / (kBalusters - 1) - 0.5);
    add_shape(house.trim, baluster, placed({x, y + 0.12, kFront + kReach - 0.08}));
  }
}

// Adds the front or the back, which is the same without door and balcony, as a front.
void add_facade(HouseShape& house, const HouseOptions& o, bool is_front) {
  for (int floor = 0; floor < o.floors; ++floor) {
    const double y = floor * o.floor_height;
    for (int i = 0; i < kWindows; ++i) {
      const double x = kCell * (i - 1);
      const bool is_door = i == 1 && is_front && (floor == 0 || floor == o.balcony_floor);
      SceneShape cell;
      if (is_door) {
        add_arched_wall(cell, {kCell, o.floor_height, kWall, 0.7, 0.0, kDoorSpring});
      } else {
        add_arched_wall(cell, {kCell, o.floor_height, kWall, kRadius, kBase, kSpring});
        add_window(house, x, y);
      }
      add_shape(house.walls, cell, placed({x, y, kFront - 0.5 * kWall}));
    }
    if (floor > 0) add_molding(house.trim, {0, y, kFront}, kHouseWidth, 0.22, 0.1, 4);
  }
  add_molding(house.trim, {0, o.floors * o.floor_height - 0.2, kFront}, kHouseWidth, 0.5, 0.35, 24);
  if (!is_front) return;
  add_door(house);
  if (o.balcony_floor > 0) add_balcony(house, o.balcony_floor * o.floor_height);
}

void append(SceneShape& to, const SceneShape& part, const glm::dmat4& transform) {
  if (!part.indices.empty()) add_shape(to, part, transform);
}

// Adds one slope of corrugated tiles, and the gable on one side.
void add_half_roof(HouseShape& house, const HouseOptions& o) {
  const double eaves = o.floors * o.floor_height;
  constexpr double kOverhang = 0.5;
  const double sink = o.roof_height * kOverhang / kFront;  // of the edge of the overhang, below the eaves
  add_surface(house.roof, 96, 20, {4, 3}, [=](double u, double v) {
    const SinCosDouble across = sincos_turns(24 * u), along = sincos_turns(10 * v);
    const double lift = 0.12 + 0.04 * across.cos + 0.02 * along.cos;
    return glm::dvec3(kHouseWidth * (u - 0.5), eaves - sink + (o.roof_height + sink) * v + lift, (kFront + kOverhang) * (1 - v));
  });
  add_surface(house.walls, 2, 4, {4, 2},
              [=](double u, double v) { return glm::dvec3(0.5 * kHouseWidth, eaves + o.roof_height * v, kFront * (1 - v) * (1 - 2 * u)); });
}

void add_chimney(HouseShape& house, const HouseOptions& o) {
  constexpr std::array<glm::dvec2, 5> kPot{{{0.14, 0.0}, {0.16, 0.25}, {0.13, 0.5}, {0.17, 0.55}, {0.1, 0.56}}};
  const double y = o.floors * o.floor_height + o.roof_height;
  add_box(house.walls, {2.4, y - 0.4, -1.0}, {1.3, 2.6, 0.6}, 0.5);
  add_box(house.trim, {2.4, y + 0.95, -1.0}, {1.5, 0.14, 0.8}, 0.5);
  SceneShape pot;
  add_lathe(pot, kPot, 16);
  for (const double x : {2.1, 2.7}) add_shape(house.roof, pot, placed({x, y + 1.0, -1.0}));
}

}  // namespace

HouseOptions house_options(uint32_t number) {
  WorkloadRandom random(1000u + 77u * number);
  const int floors = 3 + static_cast<int>(random.below(3));
  const double floor_height = random.between(2.9, 3.3), roof_height = random.between(3.0, 4.6);
  return {floors, floor_height, roof_height, static_cast<int>(random.below(3)), number};
}

HouseShape house_shape(const HouseOptions& o) {
  HouseShape house, back;
  add_facade(house, o, true);
  add_facade(back, o, false);
  add_half_roof(house, o);
  add_half_roof(back, o);
  const glm::dmat4 turned = placed({0, 0, 0}, 0.5);
  append(house.walls, back.walls, turned);
  append(house.trim, back.trim, turned);
  append(house.roof, back.roof, turned);
  append(house.wood, back.wood, turned);
  append(house.glass, back.glass, turned);
  add_chimney(house, o);
  const double eaves = o.floors * o.floor_height;
  for (const double side : {-1.0, 1.0})
    add_box(house.walls, {side * (0.5 * kHouseWidth - 0.1), 0.5 * eaves, 0}, {0.2, eaves, kHouseDepth - 0.04}, 0.5);
  add_tube(
      house.wood, 10, 16, {1, 4}, [=](double v) { return glm::dvec3(0.47 * kHouseWidth, (eaves - 0.5) * v, kFront + 0.12); },
      [](double) { return 0.05; });
  for (int i = 0; i < kWindows; ++i) {
    const SceneShape flowers = shrub_leaves({.cards = 26, .radius = 0.4, .card = 0.16, .seed = 3 * o.seed + static_cast<uint32_t>(i)});
    if (i != 1 || o.balcony_floor != 1)
      add_shape(house.plants, flowers, placed({kCell * (i - 1), o.floor_height + kBase + 0.12, kFront + 0.15}, 0.0, {1.4, 0.6, 0.5}));
  }
  return house;
}

SceneShape lamp_post() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 12> kPost{{{0.22, 0.0},
                                              {0.22, 0.3},
                                              {0.12, 0.45},
                                              {0.08, 0.9},
                                              {0.06, 2.8},
                                              {0.1, 3.0},
                                              {0.05, 3.1},
                                              {0.18, 3.2},
                                              {0.26, 3.7},
                                              {0.3, 3.72},
                                              {0.12, 3.95},
                                              {0.0, 4.05}}};
  add_lathe(shape, kPost, 24, {1, 2}, true);
  return shape;
}

SceneShape fountain() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 16> kBasin{{{3.0, 0.0},
                                               {3.0, 0.15},
                                               {2.6, 0.2},
                                               {2.6, 0.7},
                                               {2.75, 0.8},
                                               {2.4, 0.85},
                                               {2.35, 0.5},
                                               {0.5, 0.5},
                                               {0.3, 0.9},
                                               {0.25, 1.5},
                                               {1.2, 1.8},
                                               {1.3, 1.95},
                                               {0.3, 1.85},
                                               {0.18, 2.3},
                                               {0.3, 2.7},
                                               {0.0, 3.0}}};
  add_lathe(shape, kBasin, 96, {12, 3});
  return shape;
}

}  // namespace halfspace::street
