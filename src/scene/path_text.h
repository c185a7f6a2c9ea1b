// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns a path as text for a scene file. Paths can contain any bytes, but JSON contains UTF-8: control characters and bytes that are
/// not valid UTF-8 become a zero, which no path contains, followed by two hexadecimal digits.
std::string scene_text(const std::filesystem::path& path);

/// The inverse of scene_text(). Returns nothing if a zero is not followed by two hexadecimal digits.
std::optional<std::string> path_of_scene_text(std::string_view text);

}  // namespace halfspace::HS_LANES
