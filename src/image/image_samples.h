// SPDX-License-Identifier: Apache-2.0
//
// What decoders give, codes of 8 or 16 bits or numbers, and its conversions. `name` stands before the message of an
// InputError that is thrown.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <variant>

#include "halfspace/core/image.h"

namespace halfspace {

/// A decoded file as it is: codes of 8 or 16 bits, or numbers.
using ColorPicture = std::variant<Image<glm::u8vec4>, Image<glm::u16vec4>, Image<glm::vec4>>;
using GrayPicture = std::variant<Image<uint8_t>, Image<uint16_t>, Image<float>>;

/// The nearest 8-bit codes: 255·code/65535.
Image<glm::u8vec4> round_to_8_bits(const Image<glm::u16vec4>& wide);

/// The first channel (red, or grey).
GrayPicture first_channel(const ColorPicture& picture);

/// Codes over 255 or 65535 (to the nearest float), numbers as they are; throws where a number is infinite or NaN.
Image<float> to_numbers(GrayPicture picture, const std::string& name);

/// Linear RGB and alpha: codes are decoded from sRGB (alpha: over 255 or 65535), numbers are as they are, infinities
/// ±65504; throws where one is NaN. Numbers that are premultiplied are divided by their alpha where it is above 0.
Image<glm::vec4> to_linear(ColorPicture picture, bool premultiplied, const std::string& name);

}  // namespace halfspace
