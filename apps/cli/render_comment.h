// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/commands.h"

namespace halfspace {

/// Returns a command line that describes a picture at a point in time, for the text in image files. It contains only options that change
/// pixels, so no output file, threads, statistics or frame numbers. Files are named without their folders. With --turntable, the command
/// renders all frames, and --time selects the one that the picture shows.
std::string render_comment(const RenderArguments& args, double seconds);

}  // namespace halfspace
