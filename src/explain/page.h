// SPDX-License-Identifier: Apache-2.0
//
// The page of `halfspace explain`: one HTML file that shows every stage of the pipeline with the numbers of one frame.
#pragma once

#include <optional>
#include <string>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace {

struct PageOptions {
  std::string scene;                ///< name or file, as given
  std::string command;              ///< that makes the page again, without --pixel
  std::string version;              ///< of the program
  std::optional<glm::ivec2> pixel;  ///< the example pixel, from the upper left; default: the pixel with the most fragments
};

/// Returns the page. All numbers except times are the same on every machine and for any number of threads, apart from the packets, which
/// have the width of this build, and from which fragments are rejected with their block. description: of the scene at the time that is shown.
std::string explain_page(const SceneDescription& description, const PreparedScene& scene, const PageOptions& options,
                         const Workers& workers);

}  // namespace halfspace
