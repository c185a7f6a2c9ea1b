// SPDX-License-Identifier: Apache-2.0
//
// The arguments that select a scene: SCENE, --set, --camera and --shading.
#pragma once

#include <string>
#include <vector>

#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

/// Applies the settings to a scene and selects a camera unless `camera` is empty. Throws UsageError and InputError.
void set_scene(SceneFile& scene, const std::vector<std::string>& settings, const std::string& camera);

/// Like set_scene() for a SceneFile. Cameras of a model file can be selected by their name in that file as well.
void set_scene(OpenedScene& opened, const std::vector<std::string>& settings, const std::string& camera);

/// Sets the shading rate of every object unless `rate` is empty. Throws UsageError.
void set_shading(SceneFile& scene, const std::string& rate);

}  // namespace halfspace
