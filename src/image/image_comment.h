// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the comment that a PNG or OpenEXR file stores (ImageText::comment in image_io.h), without decoding pixels. Returns an empty
/// string if the file cannot be read, has another format or has no comment.
std::string image_comment(const std::filesystem::path& path);

}  // namespace halfspace::HS_LANES
