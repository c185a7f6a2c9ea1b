// SPDX-License-Identifier: Apache-2.0
//
// The text in image files, and whether such a file is whole. Pixels are not decoded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

/// Returns the text that write_image() stored in a file. All parts are empty if the file cannot be read, has another format or has no text.
ImageText read_image_text(const std::filesystem::path& path);

/// Returns false if the file is missing, or if its end is missing, for example because a copy was interrupted. The file must be one that
/// write_image() wrote: PNG, JPEG and OpenEXR are recognized by the mark or the table of their format, TIFF by its directory, and Radiance
/// by the number of bytes that is stored with the text. Damage in the middle is not found.
bool is_whole_image(const std::filesystem::path& path);

/// Begins ImageText::software of the pictures that programs of Halfspace write; the version follows.
inline constexpr std::string_view kSoftwareName = "Halfspace ";

/// Throws OutputError if a file exists that is not a picture of these programs. It could be a texture.
void check_own_image(const std::filesystem::path& path);

/// Returns the text as lines "Fingerprint: …", "Software: …" and "Comment: …", without those that are empty. JPEG files have them as a
/// comment (marker COM), TIFF files as ImageDescription, and Radiance files after the first line.
std::string text_lines(const ImageText& text);

/// Adds the text to an encoded Radiance file.
void insert_radiance_text(std::vector<std::byte>& file, const ImageText& text);

}  // namespace halfspace::HS_LANES
