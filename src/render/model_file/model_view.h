// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// How a model is shown. The default is a three-quarter view from above, which shows the whole model.
struct ModelView {
  double aspect = 16.0 / 9.0;              ///< width / height of the image
  double yaw = 35.0, pitch = 18.0;         ///< degrees; orbit angles of the eye; yaw is 0 in front (+z) and positive to the right
  double zoom = 1.0;                       ///< > 0; larger values bring the eye nearer
  double fov = 35.0;                       ///< full vertical angle in degrees
  std::optional<glm::dvec3> eye, look_at;  ///< world space; replace the computed positions
  glm::dvec3 up{0, 1, 0};
  bool inside = false;                    ///< place the camera at the center of the bounds
  bool floor = true;                      ///< shadows on a floor below the model
  std::string environment;                ///< image file; empty: a photo studio
  std::string background;                 ///< "#rrggbb", "environment", "transparent", or empty: light gray
  std::string scene, animation, variant;  ///< names or indices in the file; empty: its defaults
  std::vector<double> times;              ///< seconds; the view fits the model at all of them. Empty: 0, and no animation is chosen
  std::string up_axis = "auto";           ///< "auto", "y" or "z"
  double turn_seconds = 0.0;              ///< time in which the camera goes around the model; 0: it does not move
  bool allow_outside = false;             ///< open referenced files outside the folder of the model
};

}  // namespace halfspace::HS_LANES
