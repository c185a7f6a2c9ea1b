// SPDX-License-Identifier: Apache-2.0
//
// The options of `render` that apply to model files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/render/model_file/opened_scene.h"

namespace halfspace {

/// Values as given on the command line; empty: not given.
struct ModelArguments {
  std::string eye, look_at, up, fov, yaw, pitch, zoom;
  std::string environment, background, up_axis;
  std::string model_scene, animation, variant;
  std::string turntable;
  bool inside = false, floor = false, no_floor = false, allow_outside = false;
};

/// Opens a scene by name or file name, or generates one for a model file with the view that the options describe. `camera`: value of
/// --camera; `aspect`: width / height of the image; `fps`: frames per second of --turntable; `times`: see ModelView. Throws UsageError for
/// options that do not apply, and InputError.
OpenedScene open_scene_or_model(const std::string& scene, const ModelArguments& args, const std::string& camera, double aspect, double fps,
                                const std::vector<double>& times = {});

/// Allows all models of a scene to refer to files outside of their folders.
void allow_outside(SceneFile& scene);

/// Returns the number of frames of --turntable, or nullopt if it was not given. Throws UsageError.
std::optional<int> turntable_frames(const ModelArguments& args);

}  // namespace halfspace
