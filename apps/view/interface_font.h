// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

struct ImFontAtlas;

namespace halfspace {

/// Returns the font file of the system that the interface uses: a monospaced font, because text has columns. Empty if there is none.
std::filesystem::path interface_font();

/// Adds a font with a height of `pixels`. If the file is empty or does not exist, adds ImGui's bitmap font, enlarged to whole pixels.
void add_interface_font(ImFontAtlas& fonts, const std::filesystem::path& file, double pixels);

}  // namespace halfspace
