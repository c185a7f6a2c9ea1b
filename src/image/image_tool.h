// SPDX-License-Identifier: Apache-2.0
//
// Decoding and encoding by the program halfspace-image-tool, in a process of its own.
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

/// Decodes the file; format is OpenImageIO's name, file_bytes the file's size. Throws InputError where the file is
/// damaged, takes the decoder down, or where the program is not installed.
ColorPicture read_color_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes);
/// The same of the first channel alone.
GrayPicture read_gray_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes);

/// Encodes a picture of the header's size, channels and sample. fill_row(y, row) writes row y (0: the top one) into row,
/// which has row_bytes(header) bytes; rows are asked for once each, in order. Throws OutputError, beginning with path,
/// where the program is not installed, refuses or dies; nothing is written to path.
std::vector<std::byte> encode_by_tool(const std::filesystem::path& path, const char* format, const PictureHeader& header,
                                      const std::function<void(int y, std::span<std::byte> row)>& fill_row);

/// Where halfspace-image-tool lies, or empty where it is not installed: beside this program or in
/// ../lib/halfspace from there.
std::filesystem::path find_image_tool();

}  // namespace halfspace
