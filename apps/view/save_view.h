// SPDX-License-Identifier: Apache-2.0
//
// Saves the view as a scene file, together with the picture that `halfspace render` renders from it.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/scene/scene_file.h"

namespace halfspace {

struct ViewFiles {
  std::filesystem::path picture, scene;
};

/// Returns a scene file that starts at the given time of `scene`. Throws OutputError if the animation's own time is negative.
std::string scene_text_at(const SceneFile& scene, double seconds);

/// Renders the picture and writes both files to the folder, with the first unused number: NAME-view-1.png and NAME-view-1.json. The picture
/// is bit-identical to that of `halfspace render NAME-view-1.json --size WIDTHxHEIGHT`. Throws InputError and OutputError.
ViewFiles save_view(const SceneFile& scene, double seconds, const std::string& name, int width, int height, int threads,
                    const std::filesystem::path& folder);

}  // namespace halfspace
