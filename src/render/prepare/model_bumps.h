// SPDX-License-Identifier: Apache-2.0
//
// Bump maps of models, drawn as normal maps.
#pragma once

#include "halfspace/model/model.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/assets/warnings.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/surface/metallic_surface.h"

namespace halfspace::HS_LANES {

/// Sets the normal map of a surface to the bump map of its material, which must have one. o: an object of shape `file` that draws `model`.
/// mesh: index in the meshes of the model. A map that cannot be read is omitted with a warning.
void add_bumps(MetallicMaterial& surface, const ObjectDescription& o, const Model& model, int mesh, const ModelMaterial& material,
               UsedAssets& used, Warnings& warnings);

}  // namespace halfspace::HS_LANES
