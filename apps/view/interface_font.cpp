// SPDX-License-Identifier: Apache-2.0
#include "view/interface_font.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace halfspace {

std::filesystem::path interface_font() {
  // The packages fonts-dejavu-core and fonts-liberation of Debian and Ubuntu.
  static constexpr std::array<const char*, 2> kFiles{"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                                                     "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf"};
  const auto found = std::ranges::find_if(kFiles, [](const char* file) { return std::filesystem::exists(file); });
  return found == kFiles.end() ? std::filesystem::path() : *found;
}

void add_interface_font(ImFontAtlas& fonts, const std::filesystem::path& file, double pixels) {
  // Latin, Greek and Cyrillic letters, punctuation, arrows and mathematical signs. ImGui keeps a pointer to this list.
  static constexpr std::array<ImWchar, 13> kCharacters{0x20,   0x17f,  0x370,  0x52f,  0x2010, 0x205e, 0x20ac,
                                                       0x20ac, 0x2190, 0x2193, 0x2200, 0x22ff, 0};
  if (std::error_code error; std::filesystem::is_regular_file(file, error)) {
    fonts.AddFontFromFileTTF(file.c_str(), static_cast<float>(pixels), nullptr, kCharacters.data());
    return;
  }
  ImFontConfig bitmap;
  bitmap.SizePixels = static_cast<float>(std::floor(pixels));
  fonts.AddFontDefault(&bitmap);
}

}  // namespace halfspace
