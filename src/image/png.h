// SPDX-License-Identifier: Apache-2.0
//
// PNG in memory. png.cpp is the only file that includes libspng.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/image/image_samples.h"

namespace halfspace {

/// What the codes of a file mean.
enum class PngCodes { srgb, numbers };

/// Encodes codes with straight alpha; without an alpha channel where every alpha is 255. The file says that they are sRGB, or
/// nothing where they are numbers. The image must not be empty.
std::vector<std::byte> encode_png(const Image<glm::u8vec4>& image, PngCodes codes = PngCodes::srgb);

/// Do the bytes begin with PNG's signature?
bool is_png(std::span<const std::byte> bytes);

/// Decodes any PNG to four channels: grey is repeated, absent alpha is opaque; 8-bit codes of a file of up to 8 bits,
/// 16-bit codes of one of 16. `name` stands before the message of the InputError that is thrown for damaged or oversized
/// files.
ColorPicture decode_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace halfspace
