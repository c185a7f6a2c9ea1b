// SPDX-License-Identifier: Apache-2.0
//
// Animated WebP and GIF files.
#pragma once

#include <filesystem>
#include <memory>

#include "cli/output_files.h"
#include "cli/render_options.h"

namespace halfspace {

/// Returns an animation of the pictures of a scene, at the frame rate of the options. The encoded pictures are kept in memory; the file is
/// written after the last one.
///   webp  Each picture is lossy or lossless, whichever is smaller (libwebp). Durations are whole milliseconds.
///   gif   Each picture has its own 256 colors (giflib). Durations are hundredths of a second, at least two.
/// Throws UsageError if this build lacks the library.
std::unique_ptr<PictureSink> make_animation_file(Animation format, const RenderOptions& options, const std::filesystem::path& file);

}  // namespace halfspace
