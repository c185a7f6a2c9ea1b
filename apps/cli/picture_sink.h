// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "cli/output_files.h"
#include "cli/render_options.h"

namespace halfspace {

/// Returns the receiver of the pictures of one scene, or null if each picture has a file of its own. `file`: the file of all pictures.
std::unique_ptr<PictureSink> make_picture_sink(const RenderOptions& options, const std::filesystem::path& file);

}  // namespace halfspace
