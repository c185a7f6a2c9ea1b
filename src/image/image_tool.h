// SPDX-License-Identifier: Apache-2.0
//
// Decoding and encoding by halfspace-image-tool, in a separate process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "halfspace/image/image_samples.h"
#include "halfspace/image/tool/protocol.h"

namespace halfspace {

/// Decodes the file. format is OpenImageIO's name for the format, and file_bytes is the size of the file. Throws InputError if the
/// file is damaged or crashes the decoder, or if the program is not installed.
ColorPicture read_color_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes);
/// The same, for the first channel only.
GrayPicture read_gray_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes);

/// Encodes an image with the size, channels and sample type of the header, and returns the bytes of the file. fill_row(y, row)
/// writes row y, counted from the top, into row, which has row_bytes(header) bytes; it is called once per row, in order. Throws
/// OutputError, with a message that begins with path, if the program is not installed, reports an error or crashes. Nothing is
/// written to path.
std::vector<std::byte> encode_by_tool(const std::filesystem::path& path, const char* format, const PictureHeader& header,
                                      const std::function<void(int y, std::span<std::byte> row)>& fill_row);

/// Returns the path of halfspace-image-tool, or an empty path if it is not installed. Searches the directory of the running
/// program and ../lib/halfspace relative to it.
std::filesystem::path find_image_tool();

}  // namespace halfspace
