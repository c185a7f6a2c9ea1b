// SPDX-License-Identifier: Apache-2.0
//
// The options --max-memory, --max-pixels and --max-primitives.
#pragma once

#include <string>

#include "command_line/arguments.h"

namespace halfspace {

/// Values as given on the command line; empty: the defaults of ResourceLimits.
struct LimitArguments {
  std::string memory, pixels, primitives;
};

/// Sets the limits of this process. Throws UsageError.
void set_limits(const LimitArguments& args);

/// Throws LimitError if an image of this size exceeds a limit. bytes_per_pixel: total for all images of this size that are in memory at the
/// same time. The number of samples does not matter, because samples exist only in tiles.
void check_picture(const PictureSize& size, int bytes_per_pixel);

}  // namespace halfspace
