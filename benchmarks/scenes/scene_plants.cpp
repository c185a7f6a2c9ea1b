// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene_plants.h"

#include <array>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

glm::dvec3 random_direction(WorkloadRandom& random) {
  const double y = random.between(-1, 1), r = std::sqrt(1 - y * y);
  const SinCosDouble a = sincos_turns(random.unit());
  return {r * a.cos, y, r * a.sin};
}

// Adds a card at a point of a crown around `center`. The card has the normals of the crown, so that the crown is lit like a solid object.
void add_leaf_card(SceneShape& shape, glm::dvec3 at, glm::dvec3 center, double half, WorkloadRandom& random) {
  const glm::dvec3 outward = glm::normalize(at - center + glm::dvec3(0, 0.2 * half, 0)), any = random_direction(random);
  const glm::dvec3 right = glm::normalize(glm::cross(outward, any)), up = glm::normalize(0.8 * outward + 0.6 * glm::cross(right, outward));
  const double size = half * random.between(0.7, 1.2);
  add_card(shape, at, 0.72 * size * right, size * up, outward);
}

}  // namespace

SceneShape shrub_leaves(const ShrubOptions& o) {
  SceneShape shape;
  WorkloadRandom random(o.seed);
  for (int i = 0; i < o.cards; ++i) {
    const double r = o.radius * std::sqrt(random.between(0.2, 1.0));
    const glm::dvec3 at = r * random_direction(random) * glm::dvec3(1, 0.85, 1);
    add_leaf_card(shape, at, {0, -0.4 * o.radius, 0}, o.card, random);
  }
  return shape;
}

TreeShape tree_shape(const TreeOptions& o) {
  TreeShape tree;
  WorkloadRandom random(o.seed);
  const glm::dvec3 top{random.between(-0.5, 0.5), o.height - o.crown, random.between(-0.5, 0.5)};
  const double thick = 0.035 * o.height;
  add_tube(
      tree.wood, 14, 12, {3, 7}, [=](double v) { return glm::dvec3(top.x * v * v, top.y * v - 0.2 * (1 - v), top.z * v * v); },
      [=](double v) { return thick * (1.0 + 0.8 * (1 - v) * (1 - v) * (1 - v) * (1 - v) - 0.5 * v); });
  constexpr int kBranches = 9;
  for (int i = 0; i < kBranches; ++i) {
    const SinCosDouble a = sincos_turns(i * 0.382 + random.between(-0.05, 0.05));
    const double reach = o.crown * random.between(0.5, 0.8), from = random.between(0.65, 1.0);
    const glm::dvec3 base(top.x * from * from, top.y * from, top.z * from * from);
    const glm::dvec3 end = base + glm::dvec3(reach * a.cos, o.crown * random.between(0.3, 1.1), reach * a.sin);
    add_tube(
        tree.wood, 8, 8, {1, 3}, [=](double v) { return glm::mix(base, end, v) + glm::dvec3(0, 0.25 * o.crown * v * (1 - v), 0); },
        [=](double v) { return thick * 0.45 * (1.0 - 0.8 * v); });
    const glm::dvec3 center = end - glm::dvec3(0, 0.1 * o.crown, 0);
    for (int k = 0; k < o.cards / kBranches; ++k) {
      const double r = 0.62 * o.crown * std::sqrt(random.between(0.1, 1.0));
      const glm::dvec3 at = center + r * random_direction(random) * glm::dvec3(1, 0.75, 1);
      add_leaf_card(tree.leaves, at, top + glm::dvec3(0, 0.2 * o.crown, 0), o.card, random);
    }
  }
  return tree;
}

SceneShape pot_shape() {
  SceneShape shape;
  constexpr std::array<glm::dvec2, 9> kPot{
      {{0.0, 0.0}, {0.24, 0.0}, {0.32, 0.35}, {0.37, 0.6}, {0.42, 0.6}, {0.42, 0.7}, {0.35, 0.7}, {0.34, 0.62}, {0.0, 0.62}}};
  add_lathe(shape, kPot, 40, {2, 1});
  return shape;
}

SceneShape ground_plane(double size, int segments) {
  SceneShape shape;
  add_surface(shape, segments, segments, glm::dvec2(0.25 * size),
              [=](double u, double v) { return glm::dvec3(size * (u - 0.5), 0.0, size * (0.5 - v)); });
  return shape;
}

SceneShape sky_dome(double radius) {
  SceneShape shape;
  add_surface(shape, 64, 20, {2, 1}, [=](double u, double v) {
    const SinCosDouble around = sincos_turns(u), up = sincos_turns(0.25 * (1.1 * v - 0.1));
    return radius * glm::dvec3(up.cos * around.cos, up.sin, up.cos * around.sin);
  });
  return shape;
}

}  // namespace halfspace
