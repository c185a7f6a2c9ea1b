// SPDX-License-Identifier: Apache-2.0
//
// What a camera sees of the world, in matrices and vectors.
#pragma once

#include "halfspace/core/vec.h"
#include "halfspace/scene/description.h"

namespace halfspace {

struct View {
  glm::dmat4 clip_from_world;
  glm::dvec3 eye_ws;
  glm::dvec3 to_eye_ws;                    ///< orthographic: towards the eye from everywhere; else 0
  glm::dvec3 forward_ws, right_ws, up_ws;  ///< unit vectors
  double tan_x, tan_y;                     ///< of half the field of view
  double near, far;                        ///< units along forward_ws
  int width_px, height_px;
};

/// The view of a camera on a picture of width x height px; reversed Z.
View make_view(const CameraDescription& camera, int width, int height);

/// Width of a pixel at a point (the world's axes, the eye as origin), across the view's axis; units.
double pixel_width(const View& view, const glm::dvec3& position_rws);

/// By how many pixels at most a point's picture moves if the point, somewhere within a ball, is moved by one unit of the
/// world. The ball's own silhouette: only moves towards its centre count.
double pixels_per_unit(const View& view, const glm::dvec3& center_ws, double radius);
double silhouette_pixels_per_unit(const View& view, const glm::dvec3& center_ws, double radius);

/// Does the picture show nothing of the ball?
bool is_outside(const View& view, const glm::dvec3& center_ws, double radius);

/// The transform that a placement says: scaled, turned, then moved.
glm::dmat4 world_from_object(const Placement& placement);

}  // namespace halfspace
