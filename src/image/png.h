// SPDX-License-Identifier: Apache-2.0
//
// PNG encoding and decoding in memory. png.cpp is the only file that includes libspng.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"

namespace halfspace::HS_LANES {

/// The meaning of the 8-bit values in a file.
enum class PngCodes { srgb, numbers };

/// Encodes 8-bit values with straight alpha. Opaque images are stored without alpha. The file is marked as sRGB unless the values are
/// numbers. The image must not be empty.
std::vector<std::byte> encode_png(const Image<glm::u8vec4>& image, PngCodes codes = PngCodes::srgb, const ImageText& text = {});
/// The same with 16 bits per channel. The file is marked as sRGB.
std::vector<std::byte> encode_png(const Image<glm::u16vec4>& image, const ImageText& text = {});
/// Encodes 8-bit values with 8 bits per channel, and numbers with 16 (to_codes16).
std::vector<std::byte> encode_png(const TextureImage& image, ImageUse use);

/// Returns whether the bytes begin with the PNG signature.
bool is_png(std::span<const std::byte> bytes);

/// Decodes any PNG to four channels. Gray is replicated to all color channels; if there is no alpha channel, alpha is opaque. Files with up
/// to 8 bits per channel produce 8-bit values; files with 16 bits per channel produce 16-bit values. Throws InputError, with a message that
/// begins with `name`, for damaged or oversized files.
ColorPicture decode_png(std::span<const std::byte> bytes, const std::string& name);

/// Returns the text of a PNG file. It is empty if the bytes before the pixels are not valid or have none; the rest may be missing.
ImageText png_text(std::span<const std::byte> bytes);

}  // namespace halfspace::HS_LANES
