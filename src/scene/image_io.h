// SPDX-License-Identifier: Apache-2.0
//
// Pictures and texture maps as files. PNG is read and written here; the other formats are read by a program of its
// own, halfspace-read-image (the only user of OpenImageIO), in a process that a hostile file may kill.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "core/image.h"

namespace halfspace {

/// Writes 8-bit sRGB codes with straight alpha (without alpha where all are 255). The file appears whole or not at
/// all; throws OutputError.
void write_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Reads PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD or DDS as the codes in the file: grey is repeated, absent
/// alpha is 255, 16 bits are rounded to 8. No colour conversion, no turning by EXIF; the first picture of several.
/// The format is told by the content. Throws InputError ("PATH: what is wrong; what would be right") for what is
/// missing, damaged, too large (more than 2^28 pixels or 32768 on an edge) or holds floating-point numbers. Thread-safe.
Image<glm::u8vec4> read_image(const std::filesystem::path& path);

}  // namespace halfspace
