// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/path_text.h"

#include <charconv>

#include "halfspace/core/text.h"

namespace halfspace::HS_LANES {

std::string scene_text(const std::filesystem::path& path) { return escaped(path.string(), std::string_view("\0", 1)); }

std::optional<std::string> path_of_scene_text(std::string_view text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\0') {
      bytes += text[i];
      continue;
    }
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() != 2 || error != std::errc() || end != digits.data() + 2 || byte == 0) return std::nullopt;
    bytes += static_cast<char>(byte);
    i += 2;
  }
  return bytes;
}

}  // namespace halfspace::HS_LANES
