// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/written_model.h"

namespace halfspace::HS_LANES {

std::string image_extension(std::span<const std::byte> image) {
  const std::string_view text(reinterpret_cast<const char*>(image.data()), image.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ".png";
  return text.starts_with("\xff\xd8\xff") ? ".jpg" : "";
}

void append_text(std::vector<std::byte>& bytes, std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  bytes.insert(bytes.end(), first, first + text.size());
}

}  // namespace halfspace::HS_LANES
