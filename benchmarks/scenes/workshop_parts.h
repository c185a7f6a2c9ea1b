// SPDX-License-Identifier: Apache-2.0
//
// Parts of the workshop: the room, furniture and props. The room is centered at the origin.
#pragma once

#include "scenes/scene_shape.h"

namespace halfspace::workshop {

inline constexpr glm::dvec3 kRoom{13.0, 4.2, 9.0};
inline constexpr double kBenchHeight = 0.9;

/// Walls with a door on the left side, and with windows in front and above the bench at the back.
SceneShape walls();
SceneShape room_floor();
SceneShape ceiling();
SceneShape trusses();
SceneShape window_frames();
struct WindowPane {
  glm::dvec3 center;
  glm::dvec2 size;
};
/// The panes of all windows, in planes of constant z.
std::vector<WindowPane> window_panes();
SceneShape roof();
SceneShape gables();

SceneShape workbench();
SceneShape rack();
SceneShape machine_body();
SceneShape machine_steel();
SceneShape cart_body();
SceneShape wheel();
SceneShape stool();
SceneShape ladder();
SceneShape lamp_shade();
SceneShape lamp_bulb();
SceneShape cage();
SceneShape pegboard();

SceneShape bolt();
SceneShape nut();
SceneShape gear(int teeth);
SceneShape spring();
SceneShape bottle();
SceneShape jar();
SceneShape can();
SceneShape barrel();
SceneShape bucket();
SceneShape pipe();
SceneShape coil();
SceneShape crate();
SceneShape plank();
SceneShape cardboard_box();
SceneShape vise();
SceneShape anvil();
SceneShape pane();

/// A tool that hangs on a wall in the plane z = 0, centered at the origin. The head is steel, the handle is wood or plastic.
struct Tool {
  SceneShape head, handle;
};
Tool wrench();
Tool hammer();
Tool saw();
Tool screwdriver();

}  // namespace halfspace::workshop
