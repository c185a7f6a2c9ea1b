// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "cli/frame_clock.h"
#include "cli/output_files.h"

namespace halfspace {

/// See make_animation_file(). clock: in milliseconds.
std::unique_ptr<PictureSink> make_webp_file(const FrameClock& clock, int loop, const std::filesystem::path& file);

}  // namespace halfspace
