// SPDX-License-Identifier: Apache-2.0
//
// Textures of image files.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <variant>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/image_io.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

/// The result of read_texels().
using TextureImage = std::variant<Image<glm::u8vec4>, Image<glm::vec4>>;

/// Returns a texture that keeps the values of the image. 8-bit values give srgb8a8 (colors) or rgba8 (data). Numbers give rgba16f if each
/// of them is a half, otherwise rgba32f. Throws LimitError, with a message that begins with `place`, if the memory for numbers is not
/// available.
Texture2D texture_of(const TextureImage& image, ImageUse use, const Workers& workers, const std::string& place);

/// Converts a normal map to the form in which red, green and blue are x, y and z, with 0 for −1 and 1 for +1. A map with negative values
/// stores x, y and z as they are. A map whose blue is 0 everywhere lacks z (BC5), which is computed: normals have length 1 and point away
/// from the surface. All other maps are unchanged.
void complete_normals(TextureImage& image);

}  // namespace halfspace::HS_LANES
