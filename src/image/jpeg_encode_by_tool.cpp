// SPDX-License-Identifier: Apache-2.0
//
// JPEG encoding in builds without libjpeg.
#include "halfspace/image/image_tool.h"
#include "halfspace/image/jpeg_encode.h"

namespace halfspace::HS_LANES {

std::vector<std::byte> encode_jpeg(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text) {
  return encode_codes_by_tool(path, "jpeg", image, 3, text);
}

}  // namespace halfspace::HS_LANES
