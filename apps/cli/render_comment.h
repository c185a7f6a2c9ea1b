// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/commands.h"

namespace halfspace {

/// How a command line names files.
enum class FileNames : bool {
  without_folders,  ///< for image files, which should not reveal the folders of a machine
  as_given          ///< for commands that can be run again in the same folder
};

/// Returns a command line that describes a picture of a scene at a point in time, for example for the text in image files. It contains only
/// options that change pixels, so no output file, threads, statistics or frame numbers. With --turntable, the command renders all frames,
/// and
/// --time selects the one that the picture shows.
std::string render_comment(const RenderArguments& args, const std::string& scene, double seconds,
                           FileNames names = FileNames::without_folders);

}  // namespace halfspace
