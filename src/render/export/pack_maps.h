// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/model.h"

namespace halfspace {

/// Combines maps of materials that glTF stores in one image: metalness and roughness (blue and green), base color and opacity, and moves
/// the specular map to the alpha channel. The new images are PNG with 8 bits per channel, as large as the larger of the two maps. Maps that
/// already fit are left alone. Maps whose texture coordinates or samplers differ stay as they are, and so do images that are not in memory.
void pack_maps(Model& model);

}  // namespace halfspace
