// SPDX-License-Identifier: Apache-2.0
//
// The scene that shows a model file that was given without a scene file.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/model_file/model_view.h"

namespace halfspace::HS_LANES {

/// Name of the camera that model_scene() fits to the model.
inline constexpr const char* kFittedCamera = "view";

/// The text of a scene file, and the model that the scene shows.
struct GeneratedScene {
  std::string text;
  std::shared_ptr<const ModelAsset> model;
  std::map<std::string, std::string> camera_names;  ///< names of cameras and of their nodes in the file, and the names in the scene
  double radius = 0.0;                              ///< of the bounds of the model, in units of the scene
};

/// Returns true if the file has the extension of a model format.
bool is_model_file(const std::filesystem::path& file);

/// Reads the model and returns a scene with the object `model`, the camera kFittedCamera, the cameras of the file, and the lights of the
/// file or, if it has none, a key light with a soft shadow. If `view` has times but no animation, the first animation of the file plays.
/// Throws InputError, which names invalid values of `view` by the options of `halfspace render`, for example --animation.
GeneratedScene model_scene(const std::filesystem::path& file, const ModelView& view);

}  // namespace halfspace::HS_LANES
