// SPDX-License-Identifier: Apache-2.0
//
// Saves what is shown: a scene file, and the picture that `halfspace render` makes of it.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/scene/scene_file.h"

namespace halfspace {

struct ViewFiles {
  std::filesystem::path picture, scene;
};

/// Returns the scene as a scene file that shows at time 0 what this one shows at a time. Throws OutputError if that is not possible,
/// because the playback is before time 0.
std::string scene_text_at(const SceneFile& scene, double seconds);

/// Renders and writes both files to the folder, with the first number that is not in use: NAME-view-1.png and NAME-view-1.json. The picture
/// has the bits of `halfspace render NAME-view-1.json --size WIDTHxHEIGHT`. Throws InputError and OutputError.
ViewFiles save_view(const SceneFile& scene, double seconds, const std::string& name, int width, int height, int threads,
                    const std::filesystem::path& folder);

}  // namespace halfspace
