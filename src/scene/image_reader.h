// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>

#include "core/image.h"

namespace halfspace {

/// Decodes the file by the program halfspace-read-image, in a process of its own. format is OpenImageIO's name.
/// Throws InputError where the file is damaged, takes the decoder down, or where the program is not installed.
Image<glm::u8vec4> read_by_reader(const std::filesystem::path& path, const char* format, uint64_t file_bytes);

/// Where halfspace-read-image lies, or empty where it is not installed: beside this program or in
/// ../lib/halfspace from there.
std::filesystem::path find_image_reader();

}  // namespace halfspace
