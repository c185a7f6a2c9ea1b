// SPDX-License-Identifier: Apache-2.0
//
// Parts of the hall. Its axis is z, from the door at kEnd to the dais at −kEnd.
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace::hall {

inline constexpr int kBays = 8;
inline constexpr double kBay = 4.5, kEnd = 0.5 * kBays * kBay;  // length of a bay; half the length of the hall
inline constexpr double kNave = 4.5, kAisle = 9.0;              // distances of the columns and of the outer walls from the axis
inline constexpr double kSpring = 4.2, kAisleHeight = 6.2;      // height of the columns, and of the aisles
inline constexpr double kVaultSpring = 11.0, kEaves = 12.4, kRoofRidge = 18.2;  // bottom of the vault; bottom and top of the roof
inline constexpr double kDaisFront = -12.0, kDais = 1.44;                       // edge and height of the dais

inline double bay_center(int i) { return -kEnd + kBay * (i + 0.5); }
inline double bay_edge(int i) { return -kEnd + kBay * i; }

SceneShape arched(const ArchedWall& wall);
/// A wall across the hall with a round window in the nave, and a door if the radius is not 0.
SceneShape end_wall(double door_radius, double door_spring);
SceneShape vault();
SceneShape vault_ribs();
SceneShape floor_plane();
SceneShape aisle_ceilings();
SceneShape roofs();
SceneShape buttresses();
SceneShape column_shape();
SceneShape capital_shape();
/// Fills the opening of an arched wall.
SceneShape window_pane(double radius, double base, double spring);
SceneShape stairs();
SceneShape carpet_runner();
SceneShape bench_shape();
SceneShape baluster_shape();
SceneShape handrail();
SceneShape throne();
SceneShape chandelier();
SceneShape chandelier_flames();
SceneShape banner_shape();

}  // namespace halfspace::hall
