// SPDX-License-Identifier: Apache-2.0
//
// PNG in memory. png.cpp is the only file that includes libspng.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"

namespace halfspace {

/// Encodes sRGB codes with straight alpha; without an alpha channel where every alpha is 255. The image must not be
/// empty.
std::vector<std::byte> encode_png(const Image<glm::u8vec4>& image);

/// Do the bytes begin with PNG's signature?
bool is_png(std::span<const std::byte> bytes);

/// Decodes any PNG to four 8-bit channels: grey is repeated, absent alpha is 255, 16 bits are rounded to 8. `name`
/// stands before the message of the InputError that is thrown for damaged or oversized files.
Image<glm::u8vec4> decode_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace halfspace
