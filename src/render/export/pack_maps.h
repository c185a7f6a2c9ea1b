// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Combines material maps that glTF stores in one image: metalness (blue) with roughness (green), and base color with opacity. Moves the
/// specular map to the alpha channel. The new images are 8-bit PNGs with the size of the larger map. Maps stay unchanged if they already
/// have the right channels, if their texture coordinates or samplers differ, or if an image is not in memory. file: the name of the model
/// or scene file, which begins messages about images.
void pack_maps(Model& model, const std::string& file);

}  // namespace halfspace::HS_LANES
