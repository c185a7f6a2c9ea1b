// SPDX-License-Identifier: Apache-2.0
//
// The scene that shows a model file that was given without a scene file.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/render/model_asset.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Name of the camera that model_scene() fits to the model.
inline constexpr const char* kFittedCamera = "view";

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

/// The text of a scene file, and the model that the scene shows.
struct GeneratedScene {
  std::string text;
  std::shared_ptr<const ModelAsset> model;
  std::map<std::string, std::string> camera_names;  ///< names of cameras and of their nodes in the file, and the names in the scene
};

/// Returns true if the file has the extension of a model format.
bool is_model_file(const std::filesystem::path& file);

/// Reads the model and returns a scene with the object `model`, the camera kFittedCamera, the cameras of the file, and the lights of the
/// file or, if it has none, a key light with a soft shadow. If `view` has times but no animation, the first animation of the file plays.
/// Throws InputError, which names invalid values of `view` by the options of `halfspace render`, for example --animation.
GeneratedScene model_scene(const std::filesystem::path& file, const ModelView& view);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
