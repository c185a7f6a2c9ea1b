// SPDX-License-Identifier: Apache-2.0
//
// The output of image decoders, and its conversions. Functions that throw InputError begin the message with `name`.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <variant>

#include "halfspace/core/image.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

using GrayPicture = std::variant<Image<uint8_t>, Image<uint16_t>, Image<float>>;

/// Rounds 16-bit values to the nearest 8-bit values: 255·v/65535 for the 16-bit value v.
Image<glm::u8vec4> round_to_8_bits(const Image<glm::u16vec4>& wide);

/// Returns the first channel (red or gray).
GrayPicture first_channel(const ColorPicture& picture);

/// Returns integers divided by 255 or 65535, correctly rounded, and floats unchanged. Throws if a float is infinite or NaN.
Image<float> to_numbers(GrayPicture picture, const std::string& name);

/// Converts to linear RGB and alpha. Integer colors are decoded from sRGB; integer alpha is divided by 255 or 65535. Floats are unchanged,
/// but infinities become ±65504 and NaN throws. Premultiplied colors are divided by their alpha where it is positive.
Image<glm::vec4> to_linear(ColorPicture picture, bool premultiplied, const std::string& name);

/// Returns 8-bit values as they are. Converts colors with to_linear, and divides 16-bit data by 65535, correctly rounded.
TextureImage to_texels(ColorPicture picture, ImageUse use, bool premultiplied, const std::string& name);

/// Returns the nearest 16-bit values, which are sRGB-encoded if they are colors. Numbers outside of [0, 1] are clamped. Codes that
/// to_texels has converted are restored exactly.
Image<glm::u16vec4> to_codes16(const Image<glm::vec4>& numbers, ImageUse use);

}  // namespace halfspace::HS_LANES
