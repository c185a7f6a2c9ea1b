// SPDX-License-Identifier: Apache-2.0
//
// Opens a shipped scene, a scene file or a model file by its name.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "halfspace/render/model_file/model_scene.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace::HS_LANES {

/// A scene and, if it was generated for a model file, that file.
struct OpenedScene {
  SceneFile scene;
  std::filesystem::path model_file;  ///< empty if the scene was not generated
  std::shared_ptr<const ModelAsset> model;
  std::map<std::string, std::string> camera_names;  ///< names in the model and the corresponding names in the scene
  double model_radius = 0.0;                        ///< of the bounds of the model; 0 if the scene was not generated
};

/// Opens a scene by name or file name, or generates one that shows a model file. `view` is only used for model files. Throws InputError.
OpenedScene open_scene_or_model(const std::string& name_or_file, const ModelView& view);

/// Returns the message of an InputError with the name of the scene in front, unless it already begins with that name. If the scene was
/// generated for a model file, an error in its panorama is one of the option --environment.
std::string message_in_scene(const SceneFile& scene, const std::string& message);

/// Announces `frames` frames of width x height pixels to the assets (SceneAssets::expect), so that generated maps get the resolution that
/// the closest view of the animation needs and do not change between frames. time_of(i) is the time of frame i in seconds. Examines at most
/// a thousand frames, and only one if nothing is animated. frames must be at least 1.
void expect_frames(SceneAssets& assets, const SceneFile& scene, int frames, const std::function<double(int)>& time_of, int width,
                   int height);

}  // namespace halfspace::HS_LANES
