// SPDX-License-Identifier: Apache-2.0
//
// Reads the header of OpenEXR files, without decoding their pixels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the names of the channels of a single-part OpenEXR file, sorted. Returns an empty list if the file cannot be read or its header
/// is invalid. Source: "OpenEXR File Layout", sections Header and Channel List.
std::vector<std::string> exr_channel_names(const std::filesystem::path& file);

/// Returns ImageText::comment of an OpenEXR file, or an empty string if the file cannot be read or has none.
std::string exr_comment(const std::filesystem::path& file);

}  // namespace halfspace::HS_LANES
