// SPDX-License-Identifier: Apache-2.0
//
// Changes of a camera. Distances are relative to the distance between the camera and its target, so that they suit scenes of any size.
#pragma once

#include "halfspace/scene/description.h"
#include "view/actions.h"

namespace halfspace {

/// Moves the camera and its target along the camera's axes: x right, y up, z forward.
void move_camera(CameraDescription& camera, const glm::dvec3& distance);

/// Turns the camera around its position, to the left and upwards. It does not turn beyond the direction `up` or its opposite.
void turn_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees);

/// Moves the camera around its target, to the right and upwards. It does not move beyond the direction `up` or its opposite.
void orbit_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees);

/// Moves the camera so that the point at the depth of the target moves to the right and down with the mouse. (1, 1) is the image height.
void pan_camera(CameraDescription& camera, double right, double down);

/// Brings the camera nearer to its target: 2 halves the distance. In an orthographic view, halves the height of the view volume.
void zoom_camera(CameraDescription& camera, double factor);

/// Applies a movement for some time in seconds.
void apply_movement(CameraDescription& camera, Action movement, double seconds);

/// Moves the near and far planes outwards so that they do not cut what the camera could show before it moved.
void widen_depth_range(CameraDescription& camera);

}  // namespace halfspace
