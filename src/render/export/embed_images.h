// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Loads the images that materials use into memory, and removes the contents of all others. Images that are neither PNG nor JPEG are
/// encoded as PNG. These have 16 bits per channel, or 8 if the image has 8 or is the result of a conversion (ModelImage::converted). Numbers
/// outside of [0, 1] are clamped, with a warning. An image that cannot be read stays a file, and the model gets a warning.
///
/// Only materials of meshes that can be textured keep their converted images. All others get the factors of the conversion instead; a
/// material of both kinds of meshes is copied. file: the name of the model or scene file, which begins messages about embedded images.
/// Throws LimitError.
void embed_images(Model& model, const std::string& file);

}  // namespace halfspace::HS_LANES
