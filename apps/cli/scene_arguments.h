// SPDX-License-Identifier: Apache-2.0
//
// The arguments that select a scene: SCENE, --set, --camera and --shading.
#pragma once

#include <string>
#include <vector>

#include "halfspace/scene/scene_file.h"

namespace halfspace {

/// Opens a scene by name or file name, or the default view of a model file, applies the settings, and selects a camera unless `camera` is
/// empty. Throws UsageError and InputError.
SceneFile open_scene(const std::string& scene, const std::vector<std::string>& settings, const std::string& camera);

/// Applies the settings to a scene and selects a camera unless `camera` is empty.
void set_scene(SceneFile& scene, const std::vector<std::string>& settings, const std::string& camera);

/// Sets the shading rate of every object unless `rate` is empty. Throws UsageError.
void set_shading(SceneFile& scene, const std::string& rate);

}  // namespace halfspace
