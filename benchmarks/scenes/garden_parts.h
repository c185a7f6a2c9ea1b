// SPDX-License-Identifier: Apache-2.0
//
// Parts of the garden.
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace::garden {

inline constexpr glm::dvec2 kPond{-5.0, 3.0}, kPavilion{-11.0, -9.0}, kGreenhouse{9.5, -5.0};  // (x, z) of the centers
inline constexpr double kPondRadius = 6.5, kWater = -0.35;
inline constexpr double kPavilionRadius = 2.6, kPavilionFloor = 0.55;
inline constexpr glm::dvec3 kHouseSize{5.0, 2.3, 7.0};  // greenhouse up to the eaves; the ridge is 1.2 m higher

double ground_height(double x, double z);
inline glm::dvec3 on_ground(double x, double z, double above = 0.0) { return {x, ground_height(x, z) + above, z}; }
/// The center line of the path; v is from 0 to 1.
glm::dvec2 path_at(double v);
/// Returns whether plants may grow: not on the path, in the water or in buildings.
bool is_free(double x, double z, double margin);

SceneShape terrain();
SceneShape path();
SceneShape water();
SceneShape stone(uint32_t seed);
/// Pairs of crossed cards, scattered over a square area of the garden.
struct PatchOptions {
  glm::dvec2 center;
  double size;
  int count;
  double height;
  uint32_t seed;
};
SceneShape patch(const PatchOptions& options);
/// Cards around the pond.
SceneShape reeds(int count, double height, uint32_t seed);
SceneShape lily_pads(int count, uint32_t seed);

SceneShape pavilion_stone();
SceneShape pavilion_roof();
SceneShape pavilion_rails();
SceneShape fence();
SceneShape greenhouse_frame();
/// One pane per pair of bars: walls and roof.
std::vector<SceneShape> greenhouse_panes();
SceneShape greenhouse_tables();

}  // namespace halfspace::garden
