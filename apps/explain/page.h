// SPDX-License-Identifier: Apache-2.0
//
// The page of `halfspace explain`: an HTML file that shows every stage of the pipeline with the numbers of one frame.
#pragma once

#include <optional>
#include <string>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace {

struct PageOptions {
  std::string scene;                ///< name or file of the scene, as given by the user
  std::string command;              ///< command that generates this page, without --pixel and --lessons
  std::string render_command;       ///< command that renders the same picture
  std::string version;              ///< version of the program
  std::string lessons;              ///< address of the folder of the lessons; empty: the page does not link to them
  std::optional<glm::ivec2> pixel;  ///< example pixel, counted from the upper left; default: see example_pixel.h
};

/// Returns the page. Its numbers are the same on every machine and for any number of threads, except for times, the size of packets (which
/// depends on the build), and the choice of the fragments that are rejected with their block. `scene` must have been created from
/// `description`.
std::string explain_page(const SceneDescription& description, const PreparedScene& scene, const PageOptions& options,
                         const Workers& workers);

}  // namespace halfspace
