// SPDX-License-Identifier: Apache-2.0
//
// Reads the header of OpenEXR files, without decoding their pixels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/core/namespace.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

/// Returns the names of the channels of a single-part OpenEXR file, sorted. Returns an empty list if the file cannot be read or its header
/// is invalid. Source: "OpenEXR File Layout", sections Header and Channel List.
std::vector<std::string> exr_channel_names(const std::filesystem::path& file);

/// Returns the text of an OpenEXR file. It is empty if the file cannot be read or has none.
ImageText exr_text(const std::filesystem::path& file);

/// Returns whether a single-part OpenEXR file with scan lines contains its last block of pixels. Source: "OpenEXR File Layout", sections
/// Offset Tables and Pixel Data.
bool is_whole_exr(const std::filesystem::path& file);

}  // namespace halfspace::HS_LANES
