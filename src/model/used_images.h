// SPDX-License-Identifier: Apache-2.0
//
// The images that a model shows.
#pragma once

#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns, for each image of a model, whether a texture of a material shows it. Images that are only converted to others are not included.
std::vector<bool> used_images(const Model& model);

}  // namespace halfspace::HS_LANES
