// SPDX-License-Identifier: Apache-2.0
//
// Houses of the street.
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace::street {

inline constexpr double kHouseWidth = 8.0, kHouseDepth = 10.0;

struct HouseOptions {
  int floors;
  double floor_height;
  double roof_height;
  int balcony_floor;  ///< 0: no balcony
  uint32_t seed;      ///< of the flowers
};

/// The parts of a house, by material. The house stands at the origin with its front to +z.
struct HouseShape {
  SceneShape walls, trim, roof, wood, glass, plants;
};
HouseShape house_shape(const HouseOptions& options);

/// Returns the options of the house with this number.
HouseOptions house_options(uint32_t number);

SceneShape lamp_post();
SceneShape fountain();

}  // namespace halfspace::street
