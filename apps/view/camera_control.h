// SPDX-License-Identifier: Apache-2.0
//
// Camera movements. Distances are relative to the distance between the camera and its target, so they work for scenes of any size.
#pragma once

#include "halfspace/scene/description.h"
#include "view/actions.h"

namespace halfspace {

/// Moves the camera and its target along the camera's axes: x right, y up, z forward.
void move_camera(CameraDescription& camera, const glm::dvec3& distance);

/// Rotates the camera around its position, to the left and upwards. The rotation stops at the direction `up` and its opposite.
void turn_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees);

/// Moves the camera around its target, to the right and upwards. The movement stops at the direction `up` and its opposite.
void orbit_camera(CameraDescription& camera, double yaw_degrees, double pitch_degrees);

/// Moves the camera so that points at the depth of the target follow a mouse movement to the right and down, in units of the image height.
void pan_camera(CameraDescription& camera, double right, double down);

/// Divides the distance between the camera and its target by `factor` or, in an orthographic view, the height of the view volume.
void zoom_camera(CameraDescription& camera, double factor);

/// Applies a movement for some time in seconds. The speed is proportional to the distance of the target, but not less than if the target
/// were `nearest` away. A camera that is close to its target can then still leave a large model.
void apply_movement(CameraDescription& camera, Action movement, double seconds, double nearest = 0.0);

/// Moves the near plane to the eye and the far plane away, so that a camera movement clips nothing.
void widen_depth_range(CameraDescription& camera);

}  // namespace halfspace
