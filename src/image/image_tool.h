// SPDX-License-Identifier: Apache-2.0
//
// Decoding and encoding in separate programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"
#include "halfspace/image/image_source.h"
#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

/// Decodes a file that is not PNG: JPEG by halfspace-jpeg-tool, if it is installed, and everything else by halfspace-image-tool. Throws
/// InputError if the file is damaged or crashes the decoder, or if the program is not installed.
ColorPicture read_color_by_tool(ImageSource& source);
/// The same, for the first channel only.
GrayPicture read_gray_by_tool(ImageSource& source);

/// Encodes an image with the size, channels and sample type of the header in halfspace-image-tool, and returns the bytes of the file.
/// format is OpenImageIO's name for the format. fill_row(y, row) writes row y, counted from the top, into row, which has row_bytes(header)
/// bytes; it is called for all rows in order, and again from row 0 if a new process has to be started. Throws OutputError, with a message
/// that begins with path, if the program is not installed, reports an error or crashes. Nothing is written to path. The text is stored in
/// JPEG, TIFF and OpenEXR files.
std::vector<std::byte> encode_by_tool(const std::filesystem::path& path, const char* format, PictureHeader header, const ImageText& text,
                                      const std::function<void(int y, std::span<std::byte> row)>& fill_row);

/// The same for 8-bit values. channels is 3 or 4; 3 drops alpha.
std::vector<std::byte> encode_codes_by_tool(const std::filesystem::path& path, const char* format, const Image<glm::u8vec4>& image,
                                            uint32_t channels, const ImageText& text);

/// Returns the path of halfspace-image-tool, or an empty path if it is not installed. See find_tool().
std::filesystem::path find_image_tool();
/// The same for halfspace-jpeg-tool.
std::filesystem::path find_jpeg_tool();

}  // namespace halfspace::HS_LANES
