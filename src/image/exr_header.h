// SPDX-License-Identifier: Apache-2.0
//
// Reads the header of OpenEXR files, without decoding their pixels.
#pragma once

#include <filesystem>

#include "halfspace/core/namespace.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

/// Returns the text of an OpenEXR file. It is empty if the file cannot be read or has none.
ImageText exr_text(const std::filesystem::path& file);

/// Returns whether a single-part OpenEXR file with scan lines contains its last block of pixels. Source: "OpenEXR File Layout", sections
/// Offset Tables and Pixel Data.
bool is_whole_exr(const std::filesystem::path& file);

}  // namespace halfspace::HS_LANES
