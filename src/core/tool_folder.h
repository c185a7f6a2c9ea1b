// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Sets the folder that contains the decoder programs (halfspace-image-tool and others), for the whole process. By default, and with an
/// empty path, they are found relative to the program or shared library that contains this code. Thread-safe; files that are being read are
/// not affected.
void set_tool_folder(const std::filesystem::path& folder);

/// Returns the path of a decoder program, or an empty path if it is not installed. Searches the folder that set_tool_folder() set. If none
/// is set, searches the folder of the program or shared library that contains this code, its subfolder halfspace, and the folder in which
/// the installation keeps the decoder programs.
std::filesystem::path find_tool(const char* name);

}  // namespace halfspace::HS_LANES
