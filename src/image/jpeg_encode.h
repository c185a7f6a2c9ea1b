// SPDX-License-Identifier: Apache-2.0
//
// JPEG encoding in memory. The build chooses jpeg_encode.cpp, which uses libjpeg-turbo, or jpeg_encode_by_tool.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

/// Encodes 8-bit sRGB values at quality 95 without chroma subsampling, with the text as a comment. Alpha is dropped. The image must not be
/// empty. Throws OutputError, with a message that begins with path, if the image is too large for the format (65500 pixels per side).
/// Nothing is written to path.
std::vector<std::byte> encode_jpeg(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text);

}  // namespace halfspace::HS_LANES
