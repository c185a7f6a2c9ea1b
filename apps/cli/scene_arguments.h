// SPDX-License-Identifier: Apache-2.0
//
// Which scene a command is about: SCENE, --set and --camera.
#pragma once

#include <string>
#include <vector>

namespace halfspace {

class SceneFile;

/// The scene of that name or file with its settings made, seen by the camera of that name (empty: the scene's own). Throws
/// UsageError and InputError.
SceneFile open_scene(const std::string& scene, const std::vector<std::string>& settings, const std::string& camera);

}  // namespace halfspace
