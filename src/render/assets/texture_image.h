// SPDX-License-Identifier: Apache-2.0
//
// Textures of images, and the texels of model images.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"
#include "halfspace/model/model.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

/// What the texels of a texture stand for.
enum class TextureRole { colors, data, normals };

constexpr ImageUse image_use(TextureRole role) { return role == TextureRole::colors ? ImageUse::colors : ImageUse::data; }

/// Returns the role of a map of a material.
TextureRole role_of(TextureUse ModelMaterial::*map);

/// Reads an image without loss (read_texels), completes normals, and limits data to 0 to 1.
TextureImage texels_of(const std::filesystem::path& file, TextureRole role);
/// The same for an image of the model in `file`, which must have a file, bytes or pixels.
TextureImage texels_of(const ModelImage& image, TextureRole role, const std::string& file);
/// The same for an image in memory.
TextureImage texels_of(const ColorPicture& picture, TextureRole role, const std::string& name);

/// Converts a normal map to the form in which red, green and blue are x, y and z, with 0 for −1 and 1 for +1. The numbers of a map are x, y
/// and z themselves if more texels have the length 1 in this way than in the other. A map whose blue is 0 everywhere lacks z (BC5), which
/// is computed: normals have length 1 and point away from the surface. There, and where no texel has the length 1, numbers are x and y
/// themselves if one is negative or all are 0. All other maps are unchanged.
void complete_normals(TextureImage& image);

/// Returns a texture that keeps the values of the image. 8-bit values give srgb8a8 (colors) or rgba8 (all others). Numbers give rgba16f if
/// each of them is a half, otherwise rgba32f. Throws LimitError, with a message that begins with `place`, if the memory for numbers is not
/// available. If workers are given they share the work.
Texture2D texture_of(const TextureImage& image, TextureRole role, const std::string& place, const Workers* workers = nullptr);

/// Returns whether the texels of a format are 8-bit values of four channels.
constexpr bool has_codes(TexelFormat format) { return format == TexelFormat::srgb8a8 || format == TexelFormat::rgba8; }

/// Returns level 0 of a texture: 8-bit values, or numbers for all other formats.
TextureImage image_of(const Texture2D& texture);

}  // namespace halfspace::HS_LANES
