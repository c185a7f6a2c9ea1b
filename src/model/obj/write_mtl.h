// SPDX-License-Identifier: Apache-2.0
//
// Writes materials as MTL. The conversion is the inverse of the one in mtl_materials.h: metals and materials with maps of roughness or
// metalness are written with Pm and Pr, all others with Ns and Ks.
#pragma once

#include <string>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Inverse of linear_from_srgb. The argument is clamped to [0, 1].
float srgb_from_linear(float value);

/// Returns the text of a material library. material_names: one per material, without spaces, and a last one for ModelMaterial{}, which is
/// also written. image_names: the file name of each image; empty: the image is omitted. diagonal: length of the diagonal of the bounds of
/// the written positions. Adds a warning for each kind of property that is omitted.
std::string mtl_text(const Model& model, const std::vector<std::string>& material_names, const std::vector<std::string>& image_names,
                     double diagonal, std::vector<std::string>& warnings);

}  // namespace halfspace::HS_LANES
