// SPDX-License-Identifier: Apache-2.0
//
// Plants, and other parts that several scenes use.
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace {

/// A round bush of cards, around the origin.
struct ShrubOptions {
  int cards;
  double radius, card;  ///< card: half the height of a card
  uint32_t seed;
};
SceneShape shrub_leaves(const ShrubOptions& options);

/// A tree that stands at the origin.
struct TreeOptions {
  double height, crown;  ///< crown: radius of the crown
  int cards;
  double card;  ///< half the height of a card
  uint32_t seed;
};
struct TreeShape {
  SceneShape wood, leaves;
};
TreeShape tree_shape(const TreeOptions& options);

/// A pot with soil, 0.7 m high.
SceneShape pot_shape();

/// A square in the plane y = 0 around the origin. The texture repeats every 4 meters.
SceneShape ground_plane(double size, int segments);

/// A half sphere, with v = 0 at the horizon and v = 1 at the zenith.
SceneShape sky_dome(double radius);

}  // namespace halfspace
